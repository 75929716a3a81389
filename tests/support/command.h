// Runs the command `imp` as a shell would, and files that live as long as a test.
#pragma once

#include <fcntl.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

extern char** environ;

namespace imp::test {

inline std::string read_file(const std::filesystem::path& path) {
  std::ostringstream text;
  text << std::ifstream(path, std::ios::binary).rdbuf();
  return text.str();
}

// A folder of its own for each test, removed with it.
class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "imp_test_XXXXXX").string();
    path_ = mkdtemp(name.data());
  }
  ~Folder() { std::filesystem::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  std::string operator/(const std::string& name) const { return (path_ / name).string(); }
  std::string write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return *this / name;
  }
  std::vector<std::string> names() const {
    std::vector<std::string> all;
    for (const auto& entry : std::filesystem::directory_iterator(path_))
      all.push_back(entry.path().filename());
    return all;
  }

 private:
  std::filesystem::path path_;
};

struct CommandAnswer {
  int exit = -1;  // 128 + n: ended by signal n
  std::string out, err;
};

#ifdef IMP_COMMAND
// `imp` with these words, in folder `where` if one is given, standard input holding `input`.
inline CommandAnswer imp(const std::vector<std::string>& words, const std::string& input = {},
                         const std::string& where = {}, const char* output = nullptr) {
  const Folder folder;
  const std::string in = folder.write("in", input), err = folder / "err";
  const std::string out = output ? output : folder / "out";
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  if (!where.empty()) posix_spawn_file_actions_addchdir_np(&actions, where.c_str());
  posix_spawn_file_actions_addopen(&actions, 0, in.c_str(), O_RDONLY, 0);
  posix_spawn_file_actions_addopen(&actions, 1, out.c_str(), O_WRONLY | O_CREAT, 0600);
  posix_spawn_file_actions_addopen(&actions, 2, err.c_str(), O_WRONLY | O_CREAT, 0600);

  std::string command = IMP_COMMAND;
  std::vector<std::string> kept = words;
  std::vector<char*> argv{command.data()};
  for (std::string& word : kept) argv.push_back(word.data());
  argv.push_back(nullptr);
  pid_t child = 0;
  const int problem = posix_spawn(&child, IMP_COMMAND, &actions, nullptr, argv.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  EXPECT_EQ(problem, 0) << IMP_COMMAND;
  if (problem != 0) return {};
  int status = 0;
  waitpid(child, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), output ? "" : read_file(out),
          read_file(err)};
}
#endif

// A usage error, whose message begins with `message`.
inline void expect_usage_error(const CommandAnswer& answer, const std::string& message) {
  EXPECT_EQ(answer.exit, 2) << message;
  EXPECT_EQ(answer.out, "");
  EXPECT_TRUE(answer.err.starts_with("error: " + message)) << answer.err;
}

}  // namespace imp::test
