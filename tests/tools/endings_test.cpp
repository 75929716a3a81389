// What `imp` writes into, and how it ends where it cannot: by a message and exit 1.
#include <sys/stat.h>

#include <cstdlib>

#include <gtest/gtest.h>

#include "tests/support/command.h"
#include "tests/support/effort.h"

namespace imp {
namespace {

using test::Folder;
using test::read_file;

// The exit of a line of shell in a folder with the picture s.imp; $imp is the command.
int shell(const Folder& folder, const std::string& line) {
  folder.write("s.imp", "x^2 + y^2 + z^2 - 1\n");
  folder.write("bad.imp", "x^\n");
  const std::string whole = "cd '" + folder / "" +
                            "' && ulimit -c 0; imp='" IMP_COMMAND "'; r=\"$imp render s.imp --size 8x8\"; " +
                            line;
  const int status =
      std::system(("timeout -s KILL 60 bash -c '" + whole + "' >/dev/null 2>" + (folder / "err")).c_str());
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

struct Ending {
  std::string line;
  int exit;
  std::string message;  // a part of standard error
};

class Endings : public testing::TestWithParam<Ending> {};

TEST_P(Endings, are_by_a_message) {
  const auto& [line, exit, message] = GetParam();
  const Folder folder;
  EXPECT_EQ(shell(folder, line), exit) << line << '\n' << read_file(folder / "err");
  EXPECT_NE(read_file(folder / "err").find(message), std::string::npos) << line << read_file(folder / "err");
  for (const std::string& name : folder.names()) EXPECT_FALSE(name.ends_with(".part")) << line;
}

INSTANTIATE_TEST_SUITE_P(
    Command, Endings,
    testing::Values(
        Ending{"mkfifo f.png; (cat f.png > got) & $r -o f.png && wait && cmp got <($r -o -) && [ -p f.png ]",
               0, ""},
        Ending{"ln -s there.png d.png; $r -o d.png && [ -L d.png ] && cmp there.png <($r -o -)", 0, ""},
        Ending{"ln -s b.png a.png; ln -s c.png b.png; $r -o a.png && [ -L a.png -a -L b.png -a -f c.png ]", 0,
               ""},
        Ending{"touch a.png; chmod 640 a.png; $r -o a.png && [ $(stat -c %a a.png) = 640 ]", 0, ""},
        Ending{"ln -s /dev/full f.png; $r -o f.png; e=$?; [ -L f.png -a -c /dev/full ] || e=9; exit $e", 1,
               "cannot write 'f.png': No space left on device"},
        Ending{"(printf abc; $r -o /dev/stdout) > a.png; cmp <(tail -c +4 a.png) <($r -o -)", 0, ""},
        Ending{"$r -o /proc/self/fd/1 | cmp - <($r -o -)", 0, ""},
        Ending{"mkdir d.png; $r -o d.png", 1, "cannot write 'd.png': Is a directory"},
        Ending{"$r -o no/a.png", 1, "cannot write 'no/a.png': No such file or directory"},
        Ending{"ln -s l.png l.png; $r -o l.png", 1, "Too many levels of symbolic links"},
        Ending{"(ulimit -f 1; $r --size 99x99 -o a.png; exit $?)", 1, "cannot write 'a.png': File too large"},
        Ending{"$r -o - | true; exit ${PIPESTATUS[0]}", 1, "cannot write to standard output: Broken pipe"},
        Ending{"$imp check bad.imp 2>/dev/full", 1, ""}, Ending{"$imp check bad.imp 2>&-", 1, ""},
        Ending{"$imp nonsense 2>/dev/full", 1, ""},
        Ending{"$imp list ops >&-", 1, "cannot write to standard output"},
        Ending{"$imp check - <&-", 1, "cannot read '<stdin>'"},
        Ending{"$r -o a.png --stats >&- 2>&-; [ $? = 1 ] && cmp a.png <($r -o -)", 0, ""},
        Ending{"$imp eval s.imp --points <(echo x,y,z) --program f >/dev/full", 1,
               "No space left on device"}));

TEST(Endings, come_wherever_memory_ends) {
  if (test::sanitized) GTEST_SKIP() << "sanitizers need the whole address space";
  const Folder folder;
  for (int limit = 160'000; limit < 800'000; limit += 40'000)
    for (const std::string command : {"$r --tiles on -o a.png", "$imp inspect s.imp"}) {
      const int exit = shell(folder, "ulimit -v " + std::to_string(limit) + "; " + command);
      EXPECT_TRUE(exit == 0 || (exit == 1 && !read_file(folder / "err").empty()))
          << limit << ' ' << command << exit;
    }
}

// A FIFO without a reader does not keep interrupts away.
TEST(Endings, may_be_asked_for) {
  const Folder folder;
  EXPECT_EQ(shell(folder, "mkfifo f.png; $r -o f.png & sleep 1; kill -TERM $!; wait $!"), 128 + SIGTERM);
}

}  // namespace
}  // namespace imp
