// The command `imp`: finds the verb, reads its options, does what it says.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "ir/diagnostics.h"
#include "tools/input.h"
#include "tools/last_words.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

struct Verb {
  std::string_view name, summary;
  Action (*add)(CLI::App& verb);  // null: not there yet
};

constexpr std::array verbs{
    Verb{"render", "draw a file's surfaces into a picture", add_render},
    Verb{"eval", "values, derivatives or enclosures of f for a table of points or boxes", add_eval},
    Verb{"cast", "the first hit of every ray of a table", add_cast},
    Verb{"check", "say what is wrong in files", add_check},
    Verb{"list", "searches, inclusions, passes, ops, targets, surfaces", add_list},
    Verb{"inspect", "the Program behind a surface, and what becomes of it", add_inspect},
    Verb{"trace", "what the search did for one pixel, step by step", add_trace},
    Verb{"compile", "", nullptr},
    Verb{"bench", "", nullptr},
    Verb{"view", "", nullptr},
};

std::vector<std::string_view> verbs_there() {
  std::vector<std::string_view> names;
  for (const Verb& verb : verbs)
    if (verb.add) names.push_back(verb.name);
  return names;
}

Exit misuse(std::string_view message, std::string_view verb = {}) {
  fmt::print(stderr, "error: {}\nimp {}{}--help says more\n", message, verb, verb.empty() ? "" : " ");
  return misused;
}

// "; did you mean '--size'?" for an option that a verb does not have.
std::string nearest_option(const CLI::App& verb, const std::string& word) {
  std::vector<std::string> names;
  for (const CLI::Option* option : verb.get_options())
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  const std::vector<std::string_view> known(names.begin(), names.end());
  return did_you_mean(std::string_view(word).substr(0, word.find('=')), known);
}

int run_verb(const Verb& verb, std::vector<std::string> words) {
  CLI::App parser(std::string(verb.summary), fmt::format("imp {}", verb.name));
  parser.get_formatter()->column_width(42);
  parser.set_help_flag("--help,-h", "this text");
  const Action action = verb.add(parser);
  std::ranges::reverse(words);  // the way CLI11 takes them
  try {
    parser.parse(words);
  } catch (const CLI::CallForHelp&) {
    fmt::print("{}", parser.help());
    return fine;
  } catch (const CLI::ExtrasError&) {
    const std::string word = parser.remaining().at(0);
    const std::string hint = word.starts_with("-") ? nearest_option(parser, word) : "";
    return misuse(fmt::format("unexpected '{}'{}", word, hint), verb.name);
  } catch (const CLI::ParseError& wrong) { return misuse(wrong.what(), verb.name); }
  return action();
}

void print_help() {
  fmt::print(
      "imp: pictures of implicit surfaces that can be trusted without tuning\n\nUsage: imp VERB "
      "[OPTIONS]\n\n");
  for (const Verb& verb : verbs)
    if (verb.add) fmt::print("  {:8} {}\n", verb.name, verb.summary);
  fmt::print(
      "\nimp VERB --help says what a verb takes. - is standard input or output.\n"
      "Exit: 0 fine; 1 the input is wrong, or an output can't be written; 2 usage.\n");
}

int run(const std::vector<std::string>& words) {
  if (words.empty()) return misuse("a verb is missing");
  const std::string& first = words[0];
  if (first == "--help" || first == "-h" || first == "help") return print_help(), fine;
  if (first == "--version") return fmt::print("imp {}\n", IMP_VERSION), fine;
  if (first.starts_with("-")) return misuse(fmt::format("unexpected '{}'; a verb comes first", first));

  const auto verb = std::ranges::find(verbs, first, &Verb::name);
  if (verb == verbs.end())
    return misuse(fmt::format("unknown verb '{}'{}", first, did_you_mean(first, verbs_there())));
  if (!verb->add)
    return misuse(fmt::format("'{}' is not there yet; there are {}", first, fmt::join(verbs_there(), ", ")));
  return run_verb(*verb, {words.begin() + 1, words.end()});
}

}  // namespace
}  // namespace imp::tools

int main(int count, char** words) {
  using imp::tools::say;
  imp::tools::prepare_for_the_worst();
  try {
    const int exit = imp::tools::run({words + std::min(count, 1), words + count});
    if (std::fflush(stdout) != 0)
      say("error: cannot write to standard output\n");
    else if (exit == imp::tools::fine)
      return exit;
    else
      std::_Exit(exit);
  } catch (const std::exception& problem) { say("error: "), say(problem.what()), say("\n"); }
  std::_Exit(
      imp::tools::failed);  // nothing is taken down: a module that found no memory may hold the loader's lock
}
