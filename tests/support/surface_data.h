// Reads tests/data/surfaces.txt: formulas with exact values, derivatives and ray roots to compare with. The format is
// described in tests/data/README.md.
#pragma once

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <fstream>
#include <limits>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <system_error>
#include <utility>
#include <vector>

namespace imp::test {

// A box, or the sphere inscribed in it.
struct Domain {
  bool sphere = false;
  std::array<double, 3> lo{}, hi{};
};

// f and its derivatives at p; NaN where one does not exist or is beyond the doubles.
struct ValueRecord {
  std::array<double, 3> p{};
  std::optional<double> time;
  double f = 0;
  std::array<double, 3> gradient{};
  std::array<double, 6> hessian{};  // xx xy xz yy yz zz
};

struct Root {
  double t = 0;
  int multiplicity = 1;
};

// An almost-root, or a pair of roots 2·gap apart.
struct NearRoot {
  double t = 0, gap = 0;
};

// All roots of f(o + t·d) in [t0, t1], ascending.
struct RayRecord {
  std::array<double, 3> o{}, d{};
  double t0 = 0, t1 = 0;
  std::optional<double> time;
  bool zero_on_ray = false;  // f is 0 all along; roots is empty
  bool unresolved = false;   // the list may be incomplete
  std::vector<Root> roots;
  std::vector<NearRoot> near;
  std::vector<Root> ideal;  // roots of the ray that was meant, before its numbers were rounded
};

struct SurfaceEntry {
  std::string id, kind;  // kind: algebraic, transcendental, dynamic
  std::string source;    // as an .imp file
  Domain domain;
  std::vector<ValueRecord> values;
  std::vector<RayRecord> rays;
};

// Rays for which "undecided" is an honest answer: the first root is multiple, or another root or almost-root lies
// within a thousandth of the segment behind it or anywhere before it.
inline bool is_hard(const RayRecord& ray) {
  const double margin = 1e-3 * (ray.t1 - ray.t0);
  const double end = (ray.roots.empty() ? ray.t1 : ray.roots.front().t) + margin;
  const bool multiple = !ray.roots.empty() && ray.roots.front().multiplicity != 1;
  const bool close = ray.roots.size() > 1 && ray.roots[1].t <= end;
  const bool near =
      std::ranges::any_of(ray.near, [&](const NearRoot& n) { return n.gap < margin && n.t <= end; });
  const bool meant_multiple =
      std::ranges::any_of(ray.ideal, [&](const Root& r) { return r.multiplicity > 1 && r.t <= end; });
  return multiple || close || near || meant_multiple;
}

namespace detail {

// The words of one line, taken from left to right.
class Words {
 public:
  explicit Words(std::string_view line) : rest_(line) {}

  std::string_view word() {
    const std::size_t begin = rest_.find_first_not_of(' ');
    if (begin == std::string_view::npos) throw std::runtime_error("a word is missing");
    rest_.remove_prefix(begin);
    const std::string_view found = rest_.substr(0, rest_.find(' '));
    rest_.remove_prefix(found.size());
    return found;
  }

  std::optional<double> number_or_dash() {
    const std::string_view text = word();
    if (text == "-") return std::nullopt;
    return parse<double>(text);
  }

  double number() { return number_or_dash().value_or(std::numeric_limits<double>::quiet_NaN()); }
  int integer() { return parse<int>(word()); }

  template <std::size_t n>
  std::array<double, n> numbers() {
    std::array<double, n> found{};
    for (double& v : found) v = number();
    return found;
  }

  void expect_end() const {
    if (rest_.find_first_not_of(' ') != std::string_view::npos) throw std::runtime_error("too many words");
  }

 private:
  template <class Number>
  static Number parse(std::string_view text) {
    Number value{};
    const char* const end = text.data() + text.size();
    if (const auto [stop, error] = std::from_chars(text.data(), end, value);
        error != std::errc{} || stop != end)
      throw std::runtime_error("'" + std::string(text) + "' is not a number");
    return value;
  }

  std::string_view rest_;
};

template <class Record>
Record& last(std::vector<Record>& records) {
  if (records.empty()) throw std::runtime_error("nothing that this line could belong to");
  return records.back();
}

inline ValueRecord value_record(Words& words) {
  ValueRecord v;
  v.p = words.numbers<3>();
  v.time = words.number_or_dash();
  v.f = words.number();
  v.gradient = words.numbers<3>();
  v.hessian = words.numbers<6>();
  return v;
}

inline RayRecord ray_record(Words& words) {
  RayRecord r;
  r.o = words.numbers<3>();
  r.d = words.numbers<3>();
  r.t0 = words.number();
  r.t1 = words.number();
  r.time = words.number_or_dash();
  const std::string_view flags = words.word();
  r.zero_on_ray = flags.contains("zero");
  r.unresolved = flags.contains("unresolved");
  return r;
}

inline Root root(Words& words) {
  Root r;
  r.t = words.number();
  r.multiplicity = words.integer();
  return r;
}

inline void read_line(std::string_view line, std::vector<SurfaceEntry>& entries) {
  Words words(line);
  const std::string_view kind = words.word();
  if (kind == "surface") {
    SurfaceEntry& e = entries.emplace_back();
    e.id = words.word();
    e.kind = words.word();
    return words.expect_end();
  }
  SurfaceEntry& e = last(entries);
  if (kind == "|") {
    e.source.append(line.substr(std::min<std::size_t>(2, line.size()))).append("\n");
    return;
  }
  if (kind == "box" || kind == "sphere") {
    e.domain.sphere = kind == "sphere";
    e.domain.lo = words.numbers<3>();
    e.domain.hi = words.numbers<3>();
  } else if (kind == "value") {
    e.values.push_back(value_record(words));
  } else if (kind == "ray") {
    e.rays.push_back(ray_record(words));
  } else if (kind == "root") {
    last(e.rays).roots.push_back(root(words));
  } else if (kind == "ideal") {
    last(e.rays).ideal.push_back(root(words));
  } else if (kind == "near") {
    NearRoot& n = last(e.rays).near.emplace_back();
    n.t = words.number();
    n.gap = words.number();
  } else {
    throw std::runtime_error("unknown record '" + std::string(kind) + "'");
  }
  words.expect_end();
}

}  // namespace detail

// Throws std::runtime_error, with file and line, if surfaces.txt in that directory can't be read.
inline std::vector<SurfaceEntry> load_surfaces(const std::filesystem::path& directory) {
  const std::filesystem::path path = directory / "surfaces.txt";
  std::ifstream file(path);
  if (!file) throw std::runtime_error(path.string() + ": can't be opened");
  std::vector<SurfaceEntry> entries;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (line.empty() || line.front() == '#') continue;
    try {
      detail::read_line(line, entries);
    } catch (const std::runtime_error& error) {
      throw std::runtime_error(path.string() + ":" + std::to_string(number) + ": " + error.what());
    }
  }
  return entries;
}

}  // namespace imp::test
