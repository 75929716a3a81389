#include "ir/diagnostics.h"

#include <algorithm>
#include <array>
#include <limits>
#include <numeric>

#include <fmt/format.h>

namespace imp {
namespace {

constexpr std::size_t widest = 110;  // characters of a source line that are shown
constexpr std::size_t context = 70;  // of these before the caret, at most

bool continues_character(char c) { return (static_cast<unsigned char>(c) & 0xC0) == 0x80; }

bool is_control(char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7F; }

// The whole line around `at`, without its line break.
Span line_around(std::string_view text, std::size_t at) {
  const std::size_t before = at == 0 ? std::string_view::npos : text.rfind('\n', at - 1);
  const std::size_t begin = before == std::string_view::npos ? 0 : before + 1;
  std::size_t end = std::min(text.find('\n', at), text.size());
  if (end > begin && text[end - 1] == '\r') --end;
  return {0, static_cast<std::uint32_t>(begin), static_cast<std::uint32_t>(end)};
}

// The length of the UTF-8 character that `text` begins with; 0 if it is none.
std::size_t character_length(std::string_view text) {
  const auto lead = static_cast<unsigned char>(text[0]);
  const std::size_t length = lead < 0x80   ? 1
                             : lead < 0xC2 ? 0
                             : lead < 0xE0 ? 2
                             : lead < 0xF0 ? 3
                             : lead < 0xF5 ? 4
                                           : 0;
  if (length > text.size()) return 0;
  const std::string_view rest = text.substr(0, length).substr(std::min<std::size_t>(length, 1));
  return std::ranges::all_of(rest, continues_character) ? length : 0;
}

// A piece of a line, one column a character: what a terminal would act upon is shown as '?'.
struct Shown {
  std::string text;
  std::vector<bool> tab;  // by column
};

Shown show(std::string_view line) {
  Shown shown;
  while (!line.empty()) {
    const std::size_t length = character_length(line);
    const bool plain = length > 0 && (line[0] == '\t' || !is_control(line[0]));
    shown.text += plain ? line.substr(0, length) : "?";
    shown.tab.push_back(line[0] == '\t');
    line.remove_prefix(std::max<std::size_t>(length, 1));
  }
  return shown;
}

// `at` moved by up to `count` characters towards `end`.
std::size_t forward(std::string_view text, std::size_t at, std::size_t end, std::size_t count) {
  for (; count > 0 && at < end; --count)
    for (++at; at < end && continues_character(text[at]);) ++at;
  return at;
}

std::size_t backward(std::string_view text, std::size_t at, std::size_t begin, std::size_t count) {
  for (; count > 0 && at > begin; --count)
    for (--at; at > begin && continues_character(text[at]);) --at;
  return at;
}

// The line that holds the span's beginning, and below it the caret. Of a long line only what is
// around the caret is read.
std::string excerpt(std::string_view text, Span span) {
  const Span line = line_around(text, span.begin);
  const std::size_t caret = std::min(span.begin, line.end);
  const std::size_t last = std::clamp<std::size_t>(span.end, caret, line.end);
  const std::size_t begin = backward(text, caret, line.begin, context);
  const std::size_t end = forward(text, begin, line.end, widest);

  const Shown before = show(text.substr(begin, caret - begin));
  const Shown marked = show(text.substr(caret, std::min(last, end) - caret));
  const Shown after = show(text.substr(std::min(last, end), end - std::min(last, end)));

  const std::string_view cut_left = begin > line.begin ? "..." : "", cut_right = end < line.end ? "..." : "";
  std::string padding(cut_left.size(), ' ');
  for (const bool tab : before.tab) padding += tab ? '\t' : ' ';
  const std::string tail(marked.tab.empty() ? 0 : marked.tab.size() - 1, '~');
  return fmt::format("{}{}{}{}{}\n{}^{}\n", cut_left, before.text, marked.text, after.text, cut_right,
                     padding, tail);
}

std::string_view word(Severity severity) {
  switch (severity) {
    case Severity::error:   return "error";
    case Severity::warning: return "warning";
    case Severity::note:    return "note";
  }
  return {};
}

char lower(char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; }

constexpr std::size_t most_names = 10'000;  // that are compared
constexpr std::size_t longest_name = 40;    // beyond it nobody mistypes a name

// How many letters must be put in, taken out, replaced or swapped with their neighbour; capitals
// count as small ones.
std::size_t edit_distance(std::string_view a, std::string_view b) {
  using Row = std::array<std::size_t, longest_name + 1>;
  Row two_up{}, up{}, row{};
  std::iota(up.begin(), up.end(), std::size_t{0});
  for (std::size_t i = 1; i <= a.size(); ++i) {
    row[0] = i;
    for (std::size_t j = 1; j <= b.size(); ++j) {
      const bool same = lower(a[i - 1]) == lower(b[j - 1]);
      row[j] = std::min({up[j] + 1, row[j - 1] + 1, up[j - 1] + (same ? 0 : 1)});
      const bool swapped =
          i > 1 && j > 1 && lower(a[i - 1]) == lower(b[j - 2]) && lower(a[i - 2]) == lower(b[j - 1]);
      if (swapped) row[j] = std::min(row[j], two_up[j - 2] + 1);
    }
    two_up = up;
    up = row;
  }
  return up[b.size()];
}

std::size_t common_prefix(std::string_view a, std::string_view b) {
  return static_cast<std::size_t>(std::ranges::mismatch(a, b).in1 - a.begin());
}

}  // namespace

std::uint32_t Sources::add(std::string name, std::string text) {
  files_.push_back({std::move(name), std::move(text)});
  return static_cast<std::uint32_t>(files_.size() - 1);
}

void Diagnostics::add(Severity severity, Span span, std::string message) {
  if (severity == Severity::error) ++errors_;
  if (errors_ <= limit) all_.push_back({severity, span, std::move(message)});
}

Position position(const Sources& sources, Span span) {
  const std::string_view before = sources.text(span.file).substr(0, span.begin);
  const auto lines = static_cast<std::size_t>(std::ranges::count(before, '\n'));
  const std::string_view line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
  const auto inside = static_cast<std::size_t>(std::ranges::count_if(line, continues_character));
  return {lines + 1, line.size() - inside + 1};
}

std::string to_text(const Sources& sources, const Diagnostic& diagnostic) {
  const Span span = diagnostic.span;
  const bool placed = span.file < sources.size();  // a span of other sources has no place here
  if (!placed) return fmt::format("{}: {}\n", word(diagnostic.severity), diagnostic.message);
  const Position at = position(sources, span);
  return fmt::format("{}:{}:{}: {}: {}\n{}", sources.name(span.file), at.line, at.column,
                     word(diagnostic.severity), diagnostic.message, excerpt(sources.text(span.file), span));
}

std::string to_text(const Diagnostics& diagnostics) {
  std::string text;
  for (const Diagnostic& diagnostic : diagnostics.all()) text += to_text(diagnostics.sources, diagnostic);
  if (diagnostics.errors() > Diagnostics::limit)
    text += fmt::format("error: {} more errors are not shown\n", diagnostics.errors() - Diagnostics::limit);
  return text;
}

std::string did_you_mean(std::string_view name, std::span<const std::string_view> known) {
  if (name.size() < 2 || name.size() > longest_name) return {};
  const std::size_t tolerated = std::min<std::size_t>((name.size() + 1) / 2, 3);
  std::string_view best;
  std::size_t best_distance = std::numeric_limits<std::size_t>::max();
  for (const std::string_view candidate : known.first(std::min(known.size(), most_names))) {
    const auto [shorter, longer] = std::minmax({name.size(), candidate.size()});
    if (candidate == name || longer > longest_name || longer - shorter > tolerated) continue;
    const std::size_t distance = edit_distance(name, candidate);
    if (distance > tolerated || distance >= shorter) continue;
    const bool nearer =
        distance < best_distance ||
        (distance == best_distance && common_prefix(name, candidate) > common_prefix(name, best));
    if (nearer) best = candidate, best_distance = distance;
  }
  return best.empty() ? std::string{} : fmt::format("; did you mean '{}'?", best);
}

}  // namespace imp
