// Random input of every kind that `imp` did not ask for: text, tables, options, outputs, signals.
#pragma once

#include <algorithm>
#include <array>
#include <chrono>
#include <csignal>
#include <filesystem>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "tests/support/command.h"
#include "tests/support/random.h"

namespace imp::test {

// A line of shell in a folder with these files; $imp is the command, which a signal may hit.
struct HostileCase {
  std::vector<std::pair<std::string, std::string>> files;
  std::string line;
  int signal = 0;  // 0: none
  int after = 0;   // milliseconds
};

class Hostile {
 public:
  explicit Hostile(std::uint64_t seed) : random_(seed) {
    const std::filesystem::path examples = std::filesystem::path(IMP_SOURCE_DIR) / "examples/surfaces";
    std::vector<std::filesystem::path> paths;
    for (const auto& entry : std::filesystem::directory_iterator(examples)) paths.push_back(entry.path());
    std::ranges::sort(paths);
    for (const auto& path : paths) examples_.push_back(read_file(path));
  }

  HostileCase next() {
    switch (random_.below(5)) {
      case 0:  return of_text();
      case 1:  return of_table();
      case 2:  return of_options();
      case 3:  return of_output();
      default: return of_signal();
    }
  }

 private:
  using Words = std::vector<std::string_view>;

  std::string_view one_of(const Words& words) { return words[random_.below(words.size())]; }

  std::string number() {
    static const Words words{"0",
                             "-0",
                             "1",
                             "-1",
                             "1e308",
                             "1e-320",
                             "1e999",
                             "nan",
                             "inf",
                             "-inf",
                             "0x1p3",
                             "1.5e",
                             "1048576",
                             "2^31",
                             "4294967296",
                             ".5",
                             "5.",
                             "1e-9",
                             "999999999999999999999999",
                             "",
                             " ",
                             "3,4",
                             "one",
                             "1 2",
                             "--1",
                             "1e+",
                             "2e9"};
    return random_.one_in(2) ? std::string(one_of(words)) : fmt::format("{}", random_.between(-3, 3));
  }

  std::string bytes() {
    std::string text(random_.below(2000), ' ');
    const bool printable = random_.one_in(2);
    for (char& byte : text) byte = static_cast<char>(printable ? 32 + random_.below(95) : random_.below(256));
    return text;
  }

  std::string tokens() {
    static const Words words{
        "x",    "y",     "z",    "a",     "b",       "f",      "(",   ")",      "(",       ")",
        "[",    "]",     "|",    ",",     ":",       "=",      "+",   "-",      "*",       "/",
        "^",    "<",     ">=",   "and",   "or",      "not",    "if",  "sum",    "product", "T",
        "sqrt", "log",   "sin",  "max",   "mod",     "pi",     "1",   "2.5",    "1e9",     "\n",
        "\n  ", "param", "time", "in",    "surface", "domain", "box", "sphere", "radius",  "camera",
        "from", "to",    "fov",  "light", "f(a)",    "f(x) =", "a =", "\"s\"",  "#"};
    std::string text;
    for (std::size_t n = random_.below(60); n > 0; --n) text += std::string(one_of(words)) + ' ';
    return text;
  }

  static std::string repeated(std::string_view part, std::size_t count) {
    std::string text;
    for (; count > 0; --count) text += part;
    return text;
  }

  std::string large() {
    static const std::vector<std::array<std::string_view, 3>> shapes{
        {"(", "x", ")"},
        {"sin(", "x", ")"},
        {"", "x", "^2"},
        {"-", "x", ""},
        {"", "x", " + x"},
        {"", "x", "*(x+y)"},
        {"", "y", "-sin(x*y)"},
        {"min(x, ", "y", ")"},
        {"if(x < 1, ", "y", ", z)"},
        {"a = a*", "x", "\n"},
        {"|", "x", "|"},
        {"param p = 1\n", "x", ""},
        {"light from (1, 2, 3)\n", "x", ""},
        {"", "x = y\nsurface a: x", "\nsurface b: y"},
        {"domain box(", "x", ""}};
    const auto& [before, middle, after] = shapes[random_.below(shapes.size())];
    const std::size_t count = std::array{10u, 100u, 1000u, 30'000u, 200'000u}[random_.below(5)];
    return repeated(before, count) + std::string(middle) + repeated(after, count) + "\n";
  }

  std::string computed() {
    static const Words shapes{"sum(i, 1, {}, sin(i*x)/i) - y",
                              "product(i, 1, {}, x - i) - y",
                              "x^{} - y",
                              "T({}, x) - y",
                              "sum(i, 1, {}, x/i) = z",
                              "x - {}",
                              "x*{} + exp({}*y) - z",
                              "sum(i, 1, 100, (x*y + i)^{}) - z"};
    return replaced(std::string(one_of(shapes)), "{}",
                    random_.one_in(2) ? fmt::format("{}", random_.below(4000)) : number()) +
           '\n';
  }

  static std::string replaced(std::string text, std::string_view what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
      text.replace(at, what.size(), by);
    return text;
  }

  std::string mutated(std::string text) {
    for (std::size_t n = 1 + random_.below(4); n > 0 && !text.empty(); --n) {
      const std::size_t at = random_.below(text.size()), length = 1 + random_.below(20);
      switch (random_.below(6)) {
        case 0:  text[at] = static_cast<char>(random_.below(256)); break;
        case 1:  text.erase(at, length); break;
        case 2:  text.insert(at, text.substr(at, length)); break;
        case 3:  text.insert(at, number()); break;
        case 4:  text.insert(at, one_of({"(", ")", "\n", "^", "/", "*", "x", "=", ","})); break;
        default: {
          const std::string& other = examples_[random_.below(examples_.size())];
          text.replace(at, length, other.substr(random_.below(other.size()), length));
        }
      }
    }
    return text;
  }

  const std::string& example() { return examples_[random_.below(examples_.size())]; }

  std::string text() {
    switch (random_.below(6)) {
      case 0:  return bytes();
      case 1:  return tokens();
      case 2:  return large();
      case 3:  return computed();
      default: return mutated(example());
    }
  }

  static constexpr std::string_view points = "x,y,z\n0.5,1,2\n",
                                    boxes = "xlo,xhi,ylo,yhi,zlo,zhi\n0,1,0,1,0,1\n",
                                    rays = "ox,oy,oz,dx,dy,dz,tmin,tmax\n0,0,-5,0,0,1,0,10\n";

  std::string verb() {
    static const Words verbs{"render s.imp --size 16x16 -o a.png",
                             "render s.imp --size 16x16 --tiles on -o a.exr",
                             "eval s.imp --points p.csv --program f",
                             "eval s.imp --points p.csv --program hessian",
                             "eval s.imp --points b.csv --program interval",
                             "eval s.imp --points b.csv --program taylor",
                             "cast s.imp --rays r.csv",
                             "inspect s.imp",
                             "check s.imp",
                             "check --json s.imp",
                             "trace s.imp --pixel 3,4"};
    return std::string(one_of(verbs));
  }

  HostileCase with_files(std::string line) const {
    return {{{"s.imp", "x^2 + y^2 + z^2 - 1\n"},
             {"p.csv", std::string(points)},
             {"b.csv", std::string(boxes)},
             {"r.csv", std::string(rays)}},
            std::move(line)};
  }

  HostileCase of_text() {
    HostileCase result = with_files("exec $imp " + verb());
    result.files[0].second = text();
    return result;
  }

  std::string table(std::string_view right) {
    std::string text(right);
    static const Words cells{"\"", "\"a,b\"", "\"\"", "\r\n", "\r",  "\n\n", ",",
                             ",,", ";",       "\t",   "nan",  "inf", "-inf"};
    for (std::size_t n = random_.below(8); n > 0; --n) {
      std::string row;
      for (std::size_t i = 0, count = random_.below(12); i < count; ++i) {
        row += i == 0 ? "" : ",";
        row += random_.one_in(4) ? std::string(one_of(cells)) : number();
      }
      text += row + (random_.one_in(4) ? "" : "\n");
    }
    if (random_.one_in(4)) text += std::string(1, '\0') + bytes();
    if (random_.one_in(8)) text += repeated("1,2,3,4,5,6,7,8\n", 20'000);
    if (random_.one_in(8)) text += repeated(",", 1'000'000);
    return random_.one_in(2) ? mutated(text) : text;
  }

  HostileCase of_table() {
    static const Words verbs{"eval s.imp --points p.csv --program gradient",
                             "eval s.imp --points b.csv --program affine", "cast s.imp --rays r.csv"};
    HostileCase result = with_files("exec $imp " + std::string(one_of(verbs)));
    for (std::size_t i = 1; i < result.files.size(); ++i)
      result.files[i].second = table(result.files[i].second);
    return result;
  }

  HostileCase of_options() {
    static const Words names{"--size",    "--surface",  "--epsilon",   "--delta",     "-D",
                             "--time",    "--threads",  "--repeat",    "--backend",   "--precision",
                             "--target",  "--rounding", "--search",    "--inclusion", "--stats",
                             "--timings", "--aov",      "--thin",      "--tiles",     "--program",
                             "--passes",  "--emit",     "--economize", "--pixel",     "--nonsense",
                             "-o",        "--help",     "-",           "--"};
    static const Words values{"1x1",          "99999x1", "0x0",    "-1x5",     "w=2",
                              "p=nan",        "=",       "glsl",   "llvm",     "interpreter",
                              "float",        "double",  "march",  "isolate:", "bernstein:degree=2",
                              "auto",         "ia",      "sse4.1", "nearest",  "json",
                              "depth,normal", "hide",    "on",     "2^-11",    "world:0.1",
                              "0,0",          "1e9,1e9"};
    std::string line = "exec $imp " + verb();
    for (std::size_t n = 1 + random_.below(4); n > 0; --n) {
      line += fmt::format(" {}", one_of(names));
      if (random_.one_in(4)) continue;
      line += random_.one_in(2) ? "=" : " ";
      line += "'" + (random_.one_in(3) ? number() : std::string(one_of(values))) + "'";
    }
    return with_files(line);
  }

  HostileCase of_output() {
    static const Words outputs{"mkfifo a.png; (cat a.png >/dev/null &)",
                               "ln -s /dev/full a.png",
                               "ln -s there.png a.png",
                               "ln -s a.png a.png",
                               "mkdir a.png",
                               "echo old >a.png; chmod 400 a.png",
                               "chmod 500 .",
                               "exec >&-",
                               "exec 2>&-",
                               "exec >&- 2>&- <&-",
                               "exec >/dev/full",
                               "exec 2>/dev/full",
                               "exec > >(true)",
                               "exec 2> >(true)",
                               "exec >/dev/full 2>/dev/full",
                               "ulimit -f 1"};
    HostileCase result = of_text();
    if (random_.one_in(2)) result.files[0].second = example();
    result.line = std::string(one_of(outputs)) + "; exec $imp " + verb();
    return result;
  }

  HostileCase of_signal() {
    static constexpr std::array signals{SIGHUP,    SIGINT,  SIGQUIT, SIGTERM, SIGUSR1,
                                        SIGUSR2,   SIGALRM, SIGXCPU, SIGPROF, SIGIO,
                                        SIGVTALRM, SIGPIPE, SIGXFSZ, SIGCONT, SIGWINCH};
    HostileCase result = with_files("exec $imp " + verb() + (random_.one_in(2) ? " --timings" : ""));
    if (random_.one_in(2)) result.line = "echo old >a.png; exec $imp render s.imp --size 300x300 -o a.png";
    result.files[0].second = example();
    result.signal = signals[random_.below(signals.size())];
    result.after = static_cast<int>(random_.below(500));
    return result;
  }

  Random random_;
  std::vector<std::string> examples_;
};

struct HostileAnswer {
  int exit = -1;  // 128 + n: ended by signal n
  double seconds = 0;
  std::string problem;  // empty: all is well
};

inline bool is_whole_picture(const std::string& bytes) {
  using namespace std::string_view_literals;
  return bytes.empty() || bytes == "old\n" ||
         (bytes.starts_with("\x89"
                            "PNG") &&
          bytes.ends_with("IEND\xae"
                          "B`\x82"sv));
}

// Ends within `limit` seconds, by exit 0, 1 or 2, or by the signal that was sent; and leaves nothing half-written.
inline HostileAnswer run(const HostileCase& hostile, double limit) {
  const Folder folder;
  for (const auto& [name, text] : hostile.files) folder.write(name, text);
  const std::string line =
      fmt::format("cd '{}' && ulimit -c 0 && imp='{}' && {{ {}; }}", folder / "", IMP_COMMAND, hostile.line);
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const pid_t child = fork();
  if (child == 0) {
    setsid();
    for (const int file : {0, 1, 2}) dup2(open("/dev/null", O_RDWR), file);
    execl("/bin/bash", "bash", "-c", line.c_str(), nullptr);
    _exit(127);
  }
  HostileAnswer answer;
  int status = 0;
  bool sent = hostile.signal == 0;
  while (waitpid(child, &status, WNOHANG) == 0) {
    answer.seconds = std::chrono::duration<double>(Clock::now() - start).count();
    if (!sent && answer.seconds * 1000 > hostile.after) sent = true, kill(child, hostile.signal);
    if (answer.seconds > limit) {
      kill(child, SIGKILL);
      waitpid(child, &status, 0);
      answer.problem = fmt::format("took longer than {} s", limit);
      break;
    }
    usleep(2000);
  }
  kill(-child, SIGKILL);  // who reads or writes a pipe to it
  answer.exit = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
  const bool by_the_signal = hostile.signal != 0 && answer.exit == 128 + hostile.signal;
  if (answer.problem.empty() && answer.exit > 2 && !by_the_signal)
    answer.problem = fmt::format("ended by {}", answer.exit);
  std::filesystem::permissions(folder / "", std::filesystem::perms::owner_all);
  for (const std::string& name : folder.names()) {
    if (name.ends_with(".part")) answer.problem += " left " + name;
    const bool plain = std::filesystem::is_regular_file(std::filesystem::symlink_status(folder / name));
    if (name.ends_with(".png") && plain && !is_whole_picture(read_file(folder / name)))
      answer.problem += " left half of " + name;
  }
  return answer;
}

// With what is needed to try it again.
inline std::string to_text(const HostileCase& hostile, const HostileAnswer& answer) {
  std::string text = fmt::format("{}\n  line: {}\n", answer.problem, hostile.line);
  if (hostile.signal != 0) text += fmt::format("  signal {} after {} ms\n", hostile.signal, hostile.after);
  for (const auto& [name, content] : hostile.files) {
    std::string shown;
    for (const char c : content.substr(0, 3000))
      shown += c == '\n' || (c >= 32 && c < 127) ? std::string(1, c)
                                                 : fmt::format("\\x{:02x}", static_cast<unsigned char>(c));
    text += fmt::format("  {} ({} bytes):\n{}\n", name, content.size(), shown);
  }
  return text;
}

}  // namespace imp::test
