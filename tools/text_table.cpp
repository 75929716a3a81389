#include "tools/text_table.h"

#include <algorithm>

#include <fmt/format.h>

namespace imp::tools {

std::string to_text(const Table& table, Align align, const std::string& margin) {
  if (table.empty()) return {};
  std::vector<std::size_t> width(table[0].size());
  for (const Row& row : table)
    for (std::size_t i = 0; i < row.size(); ++i) width[i] = std::max(width[i], row[i].size());
  std::string text;
  for (const Row& row : table) {
    std::string line = margin;
    for (std::size_t i = 0; i < row.size(); ++i)
      line += align == Align::numbers && i > 0 ? fmt::format("{:>{}}  ", row[i], width[i])
                                               : fmt::format("{:<{}}  ", row[i], width[i]);
    text += line.substr(0, line.find_last_not_of(' ') + 1) + "\n";
  }
  return text;
}

}  // namespace imp::tools
