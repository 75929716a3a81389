#include "runtime/csv.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>

namespace imp {
namespace {

bool is_space(char c) { return c == ' ' || c == '\t'; }

std::string_view trimmed(std::string_view text) {
  while (!text.empty() && is_space(text.front())) text.remove_prefix(1);
  while (!text.empty() && is_space(text.back())) text.remove_suffix(1);
  return text;
}

// A cell without its quotes: "a""b" is a"b.
std::string unquoted(std::string_view cell) {
  if (cell.size() < 2 || cell.front() != '"') return std::string(cell);
  std::string text;
  for (std::size_t i = 1; i + 1 < cell.size(); ++i) {
    text += cell[i];
    if (cell[i] == '"') ++i;  // its double
  }
  return text;
}

// A number without a sign. `from_chars` says of what is too small for a double as of what is too large
// that it is out of range, and tells neither from the other.
std::optional<double> read_magnitude(std::string_view text) {
  if (text.empty() || text.front() == '-' || text.front() == '+') return std::nullopt;
  const bool hex = text.size() > 2 && text[0] == '0' && (text[1] == 'x' || text[1] == 'X');
  if (hex) text.remove_prefix(2);
  if (hex && text.front() == '-') return std::nullopt;

  double value = 0;
  const char* begin = text.data();
  const char* end = begin + text.size();
  const auto [stop, error] =
      std::from_chars(begin, end, value, hex ? std::chars_format::hex : std::chars_format::general);
  if (stop != end || error == std::errc::invalid_argument) return std::nullopt;
  if (error != std::errc::result_out_of_range) {
    const bool overflowed = std::isinf(value) && text.front() != 'i' && text.front() != 'I';
    return overflowed ? std::nullopt : std::optional(value);
  }
  const std::size_t exponent = text.find_first_of(hex ? "pP" : "eE");
  const bool tiny = exponent == std::string_view::npos ? text.starts_with("0.") || text.starts_with('.')
                                                       : text.substr(exponent + 1).starts_with('-');
  return tiny ? std::optional(0.0) : std::nullopt;
}

}  // namespace

std::optional<double> read_number(std::string_view text) {
  text = trimmed(text);
  if (text.empty()) return std::nullopt;
  const bool negative = text.front() == '-';
  if (negative || text.front() == '+') text.remove_prefix(1);
  const auto magnitude = read_magnitude(text);
  if (!magnitude) return std::nullopt;
  return negative ? -*magnitude : *magnitude;
}

void append_number(std::string& text, double value) {
  if (std::isnan(value)) {
    text += "nan";
    return;
  }
  char digits[32];
  const auto [end, error] = std::to_chars(digits, digits + sizeof digits, value);
  text.append(digits, end);
}

std::string number_text(double value) {
  std::string text;
  append_number(text, value);
  return text;
}

// One pass over the text.
class CsvReader {
 public:
  CsvReader(Csv& csv, Diagnostics& diagnostics)
      : csv_(csv), diagnostics_(diagnostics), text_(csv.sources_->text(csv.file_)) {}

  bool read() {
    if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;  // a byte order mark
    std::vector<Csv::Piece> cells;
    while (at_ < text_.size()) {
      cells.clear();
      const auto line = read_line(cells);
      if (!line) return false;
      const bool blank = cells.size() == 1 && cells[0].begin == cells[0].end;
      if (blank) continue;
      if (csv_.names_.empty())
        take_header(*line, cells);
      else
        take_row(*line, cells);
    }
    if (csv_.names_.empty())
      diagnostics_.error({csv_.file_, 0, 0}, "an empty table; its first line must name the columns");
    return !diagnostics_.has_errors();
  }

 private:
  std::optional<Csv::Piece> read_line(std::vector<Csv::Piece>& cells) {
    Csv::Piece line{at(), at()};
    for (;;) {
      const auto cell = read_cell();
      if (!cell) return std::nullopt;
      cells.push_back(*cell);
      line.end = at();
      if (at_ == text_.size()) return line;
      const char c = text_[at_];
      ++at_;
      if (c == ',') continue;
      if (line.end > line.begin && text_[line.end - 1] == '\r') --line.end;
      return line;
    }
  }

  // Up to the comma, the line break or the end of the text.
  std::optional<Csv::Piece> read_cell() {
    skip_spaces();
    const std::uint32_t begin = at();
    if (at_ < text_.size() && text_[at_] == '"') return read_quoted();
    while (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') ++at_;
    std::uint32_t end = at();
    const bool last = at_ == text_.size() || text_[at_] == '\n';
    if (last && end > begin && text_[end - 1] == '\r') --end;
    while (end > begin && is_space(text_[end - 1])) --end;
    return Csv::Piece{begin, end};
  }

  std::optional<Csv::Piece> read_quoted() {
    const std::uint32_t begin = at();
    for (;;) {
      at_ = text_.find('"', at_ + 1);
      if (at_ == std::string_view::npos) {
        diagnostics_.error({csv_.file_, begin, begin + 1}, "this quote is not closed");
        return std::nullopt;
      }
      if (at_ + 1 == text_.size() || text_[at_ + 1] != '"') break;
      ++at_;
    }
    ++at_;
    const std::uint32_t end = at();
    skip_spaces();
    if (at_ < text_.size() && text_[at_] == '\r') ++at_;
    if (at_ < text_.size() && text_[at_] != ',' && text_[at_] != '\n') {
      diagnostics_.error({csv_.file_, at(), at() + 1}, "a comma is expected after a quoted cell");
      return std::nullopt;
    }
    return Csv::Piece{begin, end};
  }

  void skip_spaces() {
    while (at_ < text_.size() && is_space(text_[at_])) ++at_;
  }

  void take_header(Csv::Piece line, const std::vector<Csv::Piece>& cells) {
    csv_.header_ = line;
    csv_.name_cells_ = cells;
    for (const Csv::Piece& cell : cells) csv_.names_.push_back(unquoted(csv_.text(cell)));
  }

  void take_row(Csv::Piece line, const std::vector<Csv::Piece>& cells) {
    const std::size_t wanted = csv_.names_.size();
    if (cells.size() != wanted) {
      diagnostics_.error(cells.size() > wanted ? csv_.span(cells[wanted]) : csv_.span(line),
                         fmt::format("{} cell{} in a row of a table with {} column{}", cells.size(),
                                     cells.size() == 1 ? "" : "s", wanted, wanted == 1 ? "" : "s"));
      return;
    }
    csv_.rows_.push_back(line);
    csv_.cells_.insert(csv_.cells_.end(), cells.begin(), cells.end());
  }

  std::uint32_t at() const { return static_cast<std::uint32_t>(at_); }

  Csv& csv_;
  Diagnostics& diagnostics_;
  std::string_view text_;
  std::size_t at_ = 0;
};

std::optional<Csv> Csv::parse(std::uint32_t file, Diagnostics& diagnostics) {
  if (diagnostics.sources.text(file).size() >= std::numeric_limits<std::uint32_t>::max()) {
    diagnostics.error(
        fmt::format("'{}' is too large: a table may have 4 GB", diagnostics.sources.name(file)));
    return std::nullopt;
  }
  Csv csv(diagnostics.sources, file);
  if (!CsvReader(csv, diagnostics).read()) return std::nullopt;
  return csv;
}

std::optional<std::size_t> Csv::column(std::string_view name, Diagnostics& diagnostics) const {
  const auto first = std::ranges::find(names_, name);
  if (first == names_.end()) return std::nullopt;
  const auto second = std::find(first + 1, names_.end(), name);
  if (second != names_.end())
    diagnostics.error(name_span(static_cast<std::size_t>(second - names_.begin())),
                      fmt::format("a second column '{}'", name));
  return static_cast<std::size_t>(first - names_.begin());
}

std::optional<std::vector<double>> Csv::numbers(std::size_t column, Diagnostics& diagnostics) const {
  std::vector<double> values(rows());
  bool right = true;
  for (std::size_t row = 0; row < rows(); ++row) {
    const Piece piece = cell(row, column);
    const std::string_view written = text(piece);
    const auto value = read_number(written.starts_with('"') ? unquoted(written) : written);
    if (value) {
      values[row] = *value;
      continue;
    }
    right = false;
    diagnostics.error(span(piece), written.empty()
                                       ? fmt::format("column '{}' needs a number here", names_[column])
                                       : fmt::format("'{}' in column '{}' is no number that a double holds",
                                                     written, names_[column]));
  }
  return right ? std::optional(std::move(values)) : std::nullopt;
}

}  // namespace imp
