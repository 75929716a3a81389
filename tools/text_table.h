// Tables as text: columns as wide as their widest cell.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace imp::tools {

using Row = std::vector<std::string>;
using Table = std::vector<Row>;

enum class Align : std::uint8_t {
  left,     // everything: words
  numbers,  // all columns but the first one to the right
};

// One line a row, each after `margin`; rows have one length. Nothing for an empty table.
std::string to_text(const Table& table, Align align = Align::left, const std::string& margin = {});

}  // namespace imp::tools
