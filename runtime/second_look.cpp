#include "runtime/second_look.h"

#include "ir/assert.h"
#include "runtime/search/search.h"

namespace imp {

void look_again(std::vector<Column>& outputs, const Program& program, std::span<const Column> inputs,
                std::size_t rows, const std::function<const Kernel*()>& kernel) {
  const auto place = [&](std::string_view name) {
    const Output* output = program.output(name);
    IMP_ASSERT(output, "an output of rays");
    return static_cast<std::size_t>(output - program.outputs.data());
  };
  const std::size_t verdict = place("verdict"), steps = place("steps");
  std::vector<std::size_t> open;
  for (std::size_t row = 0; row < rows; ++row)
    if (outputs[verdict][row] == verdict_undecided) open.push_back(row);
  if (open.empty()) return;
  const Kernel* const finer = kernel();
  if (!finer) return;

  std::vector<Column> chosen;
  for (const Column& column : inputs) {
    if (column.size() == 1) {
      chosen.push_back(column);
      continue;
    }
    Column& part = chosen.emplace_back();
    for (const std::size_t row : open) part.push_back(column[row]);
  }
  const auto found = run_rows(*finer, chosen, open.size());
  for (std::size_t i = 0; i < open.size(); ++i) {
    const bool decided = found[verdict][i] != verdict_undecided;
    for (std::size_t k = 0; k < outputs.size(); ++k) {
      double& output = outputs[k][open[i]];
      if (k == steps)
        output += found[k][i];
      else if (decided)
        output = found[k][i];
    }
  }
}

}  // namespace imp
