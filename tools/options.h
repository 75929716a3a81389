// Options that several verbs take, parsed in one place. Of an option that is given more than once the last
// one counts. What is wrong with them, values that are not there yet included, is a usage error: exit 2.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>

#include "passes/extend/inclusion.h"
#include "runtime/numbers.h"
#include "runtime/options.h"
#include "runtime/render.h"
#include "runtime/search/search.h"

namespace imp::tools {

// A word that an option takes, or will take.
struct Choice {
  std::string_view name;
  std::string_view summary;
  bool there = true;
};

// Throws a usage error that names `option`.
[[noreturn]] void refuse(std::string_view option, std::string message);

// The index of `word` among `choices`; refuses others, and those that are not there.
std::size_t choose(std::string_view option, std::string_view word, std::span<const Choice> choices);

double read_real(std::string_view option, std::string_view text);
std::size_t read_count(std::string_view option, std::string_view text, std::size_t least, std::size_t most);

// An option whose last value is given to `take`.
CLI::Option* add_value(CLI::App& verb, const std::string& names, const std::string& form,
                       const std::string& help, const std::function<void(const std::string&)>& take);

// The word behind an option with choices, as an index.
CLI::Option* add_choice(CLI::App& verb, const std::string& name, std::span<const Choice> choices,
                        const std::string& help, std::function<void(std::size_t)> take);

// --size, for the picture's width and height.
void add_size(CLI::App& verb, RenderOptions& picture);

// --economize, of verbs that show pictures.
void add_economize(CLI::App& verb, std::optional<double>& tolerance);

// What every verb that evaluates takes.
struct Options {
  KernelOptions kernel;
  Wish wish;
  const Inclusion* named_inclusion = nullptr;  // by --inclusion, `auto` too; null: none was
  SearchLimits limits;
  std::vector<Override> overrides;
  std::optional<double> time;
  std::string surface;  // empty: none is named
  std::string stats;    // text or json; empty: none is wanted
  bool timings = false;
};

void add_options(CLI::App& verb, Options& options);

// The Programs that tables of points and boxes go through, as --program names them.
std::span<const Choice> evaluations();

// The words for reports.
std::string_view backend_name(Backend backend);
std::string_view precision_name(Type precision);

}  // namespace imp::tools
