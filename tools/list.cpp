// imp list: tables of what there is, from the tables that the compiler itself uses.
#include <algorithm>
#include <filesystem>
#include <fstream>

#include <fmt/format.h>

#include "backends/llvm/target.h"
#include "ir/op.h"
#include "runtime/kernel.h"
#include "tools/input.h"
#include "tools/options.h"
#include "tools/text_table.h"
#include "tools/verbs.h"

namespace imp::tools {
namespace {

namespace fs = std::filesystem;

Table searches_table() {
  Table table{{"auto", "what fits the surface"}};
  for (const Search& search : searches())
    table.push_back({std::string(search.name), std::string(search.summary)});
  return table;
}

Table inclusions_table() {
  Table table;
  for (const Inclusion& inclusion : inclusions())
    table.push_back({std::string(inclusion.name), std::string(inclusion.summary)});
  return table;
}

std::string_view word(Preserves preserves) {
  switch (preserves) {
    case Preserves::bits:      return "keeps every bit";
    case Preserves::value:     return "keeps the value, may round differently";
    case Preserves::enclosure: return "a value becomes an enclosure of it";
  }
  return {};
}

Table passes_table() {
  Table table;
  for (const Pass& pass : all_passes())
    table.push_back({std::string(pass.name), std::string(word(pass.preserves))});
  return table;
}

std::string_view word(OpKind kind) {
  switch (kind) {
    case OpKind::real:       return "real";
    case OpKind::elementary: return "elementary";
    case OpKind::upward:     return "upward";
    case OpKind::compare:    return "compare";
    case OpKind::logic:      return "logic";
    case OpKind::choice:     return "choice";
    case OpKind::convert:    return "convert";
    case OpKind::packet:     return "packet";
    case OpKind::structure:  return "structure";
  }
  return {};
}

Table ops_table() {
  Table table{{"op", "arity", "kind", "meaning"}};
  for (int i = 0; i < op_count; ++i) {
    const OpInfo& op = info(static_cast<Op>(i));
    table.push_back({std::string(op.name), std::to_string(op.arity), std::string(word(op.kind)),
                     op.kind == OpKind::structure ? "" : std::string(op.meaning)});
  }
  return table;
}

Table targets_table() {
  Table table{{"target", "processor", "bits", "here"}};
  for (const CpuTarget& target : cpu_targets())
    table.push_back(
        {target.name, target.cpu, std::to_string(target.register_bits), target.runs_here ? "yes" : "no"});
  return table;
}

// The examples: installed beside the command, or in the source tree around the command or around here.
std::optional<fs::path> surfaces_folder() {
  std::error_code ignored;
  const fs::path executable = fs::read_symlink("/proc/self/exe", ignored).parent_path();
  if (fs::path installed = executable / "../share/imp/surfaces"; fs::is_directory(installed, ignored))
    return installed.lexically_normal();
  for (const fs::path& start : {executable, fs::current_path(ignored)})
    for (fs::path folder = start; !folder.empty(); folder = folder.parent_path()) {
      if (fs::path examples = folder / "examples/surfaces"; fs::is_directory(examples, ignored))
        return examples;
      if (folder == folder.parent_path()) break;
    }
  return std::nullopt;
}

// What the comment at a file's top says first.
std::string first_comment(const fs::path& path) {
  std::ifstream file(path);
  std::string line;
  if (!std::getline(file, line) || !line.starts_with("#")) return {};
  const std::size_t begin = line.find_first_not_of("# ");
  return begin == std::string::npos ? "" : line.substr(begin);
}

Table surfaces_table() {
  Table table;
  if (const auto folder = surfaces_folder())
    for (const auto& entry : fs::directory_iterator(*folder))
      if (entry.path().extension() == ".imp")
        table.push_back({fs::proximate(entry.path()).string(), first_comment(entry.path())});
  std::ranges::sort(table);
  return table;
}

struct Topic {
  std::string_view name;
  Table (*table)();
};

constexpr Topic topics[] = {
    {"searches", searches_table}, {"inclusions", inclusions_table}, {"passes", passes_table},
    {"ops", ops_table},           {"targets", targets_table},       {"surfaces", surfaces_table},
};

Exit print_topic(std::string_view name) {
  const Table table = std::ranges::find(topics, name, &Topic::name)->table();
  Diagnostics diagnostics;
  Output output;
  if (table.empty())
    diagnostics.error(fmt::format("no {} are found", name));
  else
    output.text = to_text(table);
  if (output.close(diagnostics) && !diagnostics.has_errors()) return fine;
  print(diagnostics);
  return failed;
}

}  // namespace

Action add_list(CLI::App& verb) {
  static const std::vector<Choice> words = [] {
    std::vector<Choice> choices;
    for (const Topic& topic : topics) choices.push_back({topic.name, ""});
    return choices;
  }();
  auto topic = std::make_shared<std::string>();
  verb.add_option_function<std::string>(
          "TOPIC", [topic](const std::string& word) { *topic = words[choose("list", word, words)].name; },
          "searches, inclusions, passes, ops, targets or surfaces")
      ->required();
  return [topic] { return print_topic(*topic); };
}

}  // namespace imp::tools
