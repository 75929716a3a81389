#include "tools/options.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "backends/llvm/target.h"
#include "ir/diagnostics.h"
#include "runtime/csv.h"

namespace imp::tools {
namespace {

constexpr Choice backends[] = {
    // in the order of Backend
    {"llvm", "machine code of this computer"},
    {"interpreter", "the reference: slow and obvious"},
    {"glsl", "a shader, run by OSMesa without a window"},
};
constexpr Choice precisions[] = {{"float", "32 bits"}, {"double", "64 bits"}};
constexpr Choice roundings[] = {
    {"outward", "enclosures hold in spite of rounding"},
    {"nearest", "as in the papers: faster, and not sound"},
};
constexpr Choice evaluation_choices[] = {
    {"f", ""},      {"gradient", ""}, {"hessian", ""},    {"interval", ""},
    {"affine", ""}, {"taylor", ""},   {"mean-value", ""},
};

std::vector<Choice> target_choices(const std::vector<CpuTarget>& targets) {
  std::vector<Choice> choices;
  choices.reserve(targets.size());
  for (const CpuTarget& target : targets) choices.push_back({target.name, target.cpu});
  return choices;
}

std::vector<Choice> search_choices() {
  std::vector<Choice> choices{{"auto", "what fits the surface"}};
  for (const Search& search : searches()) choices.push_back({search.name, search.summary});
  return choices;
}

std::vector<Choice> inclusion_choices() {
  std::vector<Choice> choices;
  for (const Inclusion& inclusion : inclusions()) choices.push_back({inclusion.name, inclusion.summary});
  return choices;
}

// 2^-11, or a number.
double read_power(std::string_view option, const std::string& text) {
  const std::size_t hat = text.find('^');
  if (hat == std::string::npos) return read_real(option, text);
  return std::pow(read_real(option, std::string_view(text).substr(0, hat)),
                  read_real(option, std::string_view(text).substr(hat + 1)));
}

double read_epsilon(const std::string& text) {
  constexpr std::string_view option = "--epsilon";
  const double value = read_power(option, text);
  if (!(value > 0 && value <= 1)) refuse(option, fmt::format("'{}' is not above 0 and at most 1", text));
  return value;
}

Override read_override(const std::string& text) {
  constexpr std::string_view option = "-D";
  const std::size_t equals = text.find('=');
  if (equals == 0 || equals == std::string::npos)
    refuse(option, fmt::format("'{}' is not of the form name=value", text));
  return {text.substr(0, equals), read_real(option, std::string_view(text).substr(equals + 1))};
}

constexpr std::size_t longest_side = 65536;
constexpr std::size_t most_pixels = std::size_t{1} << 28;

// 1024x768
std::pair<std::size_t, std::size_t> read_size(std::string_view text) {
  constexpr std::string_view option = "--size";
  const std::size_t cross = text.find('x');
  if (cross == std::string_view::npos) refuse(option, fmt::format("'{}' is not of the form 1024x1024", text));
  const std::size_t width = read_count(option, text.substr(0, cross), 1, longest_side);
  const std::size_t height = read_count(option, text.substr(cross + 1), 1, longest_side);
  if (width * height > most_pixels)
    refuse(option, fmt::format("{} has more than {} pixels", text, most_pixels));
  return {width, height};
}

// "there are llvm, interpreter"
std::string those_there(const std::vector<std::string_view>& names) {
  return fmt::format("there {} {}", names.size() == 1 ? "is" : "are", fmt::join(names, ", "));
}

// "true" is how CLI11 writes a flag without a word.
std::string check_stats(std::string& word) {
  if (word == "true") word = "text";
  return word == "text" || word == "json" ? "" : fmt::format("unknown '{}'; there are text, json", word);
}

}  // namespace

void refuse(std::string_view option, std::string message) {
  throw CLI::ValidationError(std::string(option), std::move(message));
}

std::size_t choose(std::string_view option, std::string_view word, std::span<const Choice> choices) {
  std::vector<std::string_view> names;
  for (const Choice& choice : choices)
    if (choice.there) names.push_back(choice.name);
  const auto it = std::ranges::find(choices, word, &Choice::name);
  if (it != choices.end() && it->there) return static_cast<std::size_t>(it - choices.begin());
  if (it != choices.end()) refuse(option, fmt::format("'{}' is not there yet; {}", word, those_there(names)));
  const std::string hint = did_you_mean(word, names);
  refuse(option, fmt::format("unknown '{}'{}", word, hint.empty() ? "; " + those_there(names) : hint));
}

double read_real(std::string_view option, std::string_view text) {
  const auto value = read_number(text);
  if (!value) refuse(option, fmt::format("'{}' is no number", text));
  return *value;
}

std::size_t read_count(std::string_view option, std::string_view text, std::size_t least, std::size_t most) {
  const auto value = read_number(text);
  const bool right = value && *value == std::floor(*value) && static_cast<double>(least) <= *value &&
                     *value <= static_cast<double>(most);
  if (!right) refuse(option, fmt::format("'{}' is no whole number from {} to {}", text, least, most));
  return static_cast<std::size_t>(*value);
}

CLI::Option* add_value(CLI::App& verb, const std::string& names, const std::string& form,
                       const std::string& help, const std::function<void(const std::string&)>& take) {
  return verb.add_option_function<std::string>(names, take, help)->type_name(form)->take_last();
}

CLI::Option* add_choice(CLI::App& verb, const std::string& name, std::span<const Choice> choices,
                        const std::string& help, std::function<void(std::size_t)> take) {
  std::string form;
  for (const Choice& choice : choices)
    if (choice.there) form += fmt::format("{}{}", form.empty() ? "" : "|", choice.name);
  return add_value(verb, name, form, help, [name, choices, take = std::move(take)](const std::string& word) {
    take(choose(name, word, choices));
  });
}

void add_size(CLI::App& verb, RenderOptions& picture) {
  add_value(verb, "--size", "WxH", "in pixels (1024x1024)", [&picture](const std::string& text) {
    std::tie(picture.width, picture.height) = read_size(text);
  });
}

void add_economize(CLI::App& verb, std::optional<double>& tolerance) {
  add_value(verb, "--economize", "TOLERANCE",
            "enclose polynomials that are shorter than those of f, and this close to it, as 1e-6",
            [&tolerance](const std::string& text) {
              tolerance = read_power("--economize", text);
              if (!(*tolerance > 0 && *tolerance < INFINITY))
                refuse("--economize", fmt::format("'{}' is not above 0 and finite", text));
            });
}

void add_options(CLI::App& verb, Options& options) {
  static const std::vector<CpuTarget> targets = cpu_targets();
  static const std::vector<Choice> target_words = target_choices(targets);
  static const std::vector<Choice> search_words = search_choices();
  static const std::vector<Choice> inclusion_words = inclusion_choices();

  add_value(verb, "--surface", "NAME", "the surface, where the file has several",
            [&](const std::string& name) { options.surface = name; });
  add_choice(verb, "--backend", backends, "what runs (llvm)",
             [&](std::size_t i) { options.kernel.backend = static_cast<Backend>(i); });
  add_choice(verb, "--precision", precisions, "of the numbers (float)",
             [&](std::size_t i) { options.kernel.precision = i == 0 ? f32 : f64; });
  add_choice(verb, "--target", target_words, "the processor (host)",
             [&](std::size_t i) { options.kernel.target = targets[i].name; });
  add_choice(verb, "--rounding", roundings, "of enclosures (outward)",
             [&](std::size_t i) { options.kernel.outward = i == 0; });
  add_choice(verb, "--search", search_words, "the strategy along a ray (auto)",
             [&](std::size_t i) { options.wish.search = search_named(search_words[i].name); });
  add_choice(verb, "--inclusion", inclusion_words, "how f is enclosed (auto; by --program=interval: ia)",
             [&](std::size_t i) {
               options.named_inclusion = &inclusions()[i];
               options.wish.inclusion = inclusion_words[i].name == "auto" ? nullptr : &inclusions()[i];
             });
  add_value(verb, "--epsilon", "E", "a piece of this share of a ray's segment is no longer split, as 2^-11",
            [&](const std::string& text) { options.limits.epsilon = read_epsilon(text); });
  add_value(verb, "--time", "V", "the time",
            [&](const std::string& text) { options.time = read_real("--time", text); });
  verb.add_option_function<std::vector<std::string>>(
          "-D",
          [&](const std::vector<std::string>& texts) {
            for (const std::string& text : texts) options.overrides.push_back(read_override(text));
          },
          "a parameter's value; may be repeated")
      ->type_name("NAME=VALUE")
      ->allow_extra_args(false);
  verb.add_flag_function(
      "--timings", [&](std::int64_t) { options.timings = true; },
      "milliseconds of every stage, on standard error");
  verb.add_flag("--stats", options.stats, "counts and times, on standard error")
      ->type_name("[=json]")
      ->transform(CLI::Validator(check_stats, ""));
}

std::span<const Choice> evaluations() { return evaluation_choices; }

std::string_view backend_name(Backend backend) { return backends[static_cast<std::size_t>(backend)].name; }

std::string_view precision_name(Type precision) { return precision == f32 ? "float" : "double"; }

}  // namespace imp::tools
