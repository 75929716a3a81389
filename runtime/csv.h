// Tables as text: comma separated values with a header line (RFC 4180). A table is a source text like
// any other, so what is wrong in it is answered with line and column.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "ir/diagnostics.h"

namespace imp {

// The number that `text` is, spaces around it aside: 1, -2.5e-3, +1, 0x1p-3, inf, -inf, nan. Nothing if
// it is none, or is beyond the doubles; what is too small for them is 0.
std::optional<double> read_number(std::string_view text);

// Appends the shortest text that reads back to the same double: 0.1, 1e+30, -0, inf, -inf, nan.
void append_number(std::string& text, double value);
std::string number_text(double value);

class Csv {
 public:
  // Splits the text of a file of `diagnostics.sources`, which must outlive the table. Blank lines are
  // no rows; spaces around names do not count. Errors: no header, a row with more or fewer cells than
  // the header, a quote that is not closed or not alone in its cell.
  static std::optional<Csv> parse(std::uint32_t file, Diagnostics& diagnostics);

  std::size_t rows() const { return rows_.size(); }
  std::span<const std::string> names() const { return names_; }

  // Where `name` stands in the header; nothing if it does not. Twice is an error.
  std::optional<std::size_t> column(std::string_view name, Diagnostics& diagnostics) const;

  // Every row's number in this column. Errors point at cells that are none.
  std::optional<std::vector<double>> numbers(std::size_t column, Diagnostics& diagnostics) const;

  // As they stand in the file, without the line break.
  std::string_view header_text() const { return text(header_); }
  std::string_view row_text(std::size_t row) const { return text(rows_[row]); }

  Span header_span() const { return {file_, header_.begin, header_.end}; }
  Span name_span(std::size_t column) const { return span(name_cells_[column]); }

 private:
  friend class CsvReader;

  struct Piece {  // bytes of the text
    std::uint32_t begin = 0, end = 0;
  };

  Csv(const Sources& sources, std::uint32_t file) : sources_(&sources), file_(file) {}
  std::string_view text(Piece piece) const {
    return sources_->text(file_).substr(piece.begin, piece.end - piece.begin);
  }
  Span span(Piece piece) const { return {file_, piece.begin, piece.end}; }
  Piece cell(std::size_t row, std::size_t column) const { return cells_[row * names_.size() + column]; }

  const Sources* sources_;
  std::uint32_t file_;
  Piece header_;
  std::vector<std::string> names_;
  std::vector<Piece> name_cells_;
  std::vector<Piece> rows_;
  std::vector<Piece> cells_;  // row by row, without the spaces around them
};

}  // namespace imp
