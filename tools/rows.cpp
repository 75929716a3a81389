#include "tools/rows.h"

#include <algorithm>

#include <fmt/format.h>

#include "runtime/second_look.h"
#include "tools/input.h"

namespace imp::tools {
namespace {

constexpr std::string_view point_columns[] = {"x", "y", "z"};
constexpr std::string_view box_columns[] = {"xlo", "xhi", "ylo", "yhi", "zlo", "zhi"};
constexpr std::string_view ray_columns[] = {"ox", "oy", "oz", "dx", "dy", "dz", "tmin", "tmax"};

std::span<const std::string_view> columns_of(Rows rows) {
  switch (rows) {
    case Rows::points: return point_columns;
    case Rows::boxes:  return box_columns;
    case Rows::rays:   return ray_columns;
  }
  return {};
}

std::string_view name_of(Rows rows) {
  constexpr std::string_view names[] = {"points", "boxes", "rays"};
  return names[static_cast<std::size_t>(rows)];
}

// Collects the inputs of a Program from the columns of a table.
class Inputs {
 public:
  Inputs(const Csv& csv, Rows rows, Diagnostics& diagnostics)
      : csv_(csv), own_(columns_of(rows)), boxes_(rows == Rows::boxes), diagnostics_(diagnostics) {}

  // The columns that every row must have.
  void take_own() {
    std::vector<std::string_view> missing;
    for (const std::string_view name : own_)
      if (const auto column = csv_.column(name, diagnostics_))
        take(*column);
      else
        missing.push_back(name);
    if (missing.empty()) return;
    diagnostics_.error(csv_.header_span(),
                       fmt::format("no column '{}'; there must be {}", missing[0], fmt::join(own_, ",")));
  }

  // A uniform: a column of its name, or the same value in every row.
  void take_uniform(const std::string& name, double value) {
    const auto both = find(name);
    if (!boxes_) return both ? take(*both) : take_value(value);
    const auto lo = find(name + "lo"), hi = find(name + "hi");
    for (const auto& [here, other, end] : {std::tuple{lo, hi, "hi"}, {hi, lo, "lo"}})
      if (here && !other)
        diagnostics_.error(csv_.name_span(*here), fmt::format("no column '{}{}' beside this one", name, end));
    if (both && lo && hi)
      diagnostics_.error(csv_.name_span(*both),
                         fmt::format("'{0}' is given by '{0}lo' and '{0}hi' as well", name));
    for (const auto& end : {lo, hi})
      if (end)
        take(*end);
      else if (both)
        take(*both);
      else
        take_value(value);
  }

  std::vector<Column> columns;

 private:
  std::optional<std::size_t> find(const std::string& name) const {
    if (std::ranges::find(own_, name) != own_.end()) return std::nullopt;  // it means something else
    return csv_.column(name, diagnostics_);
  }
  void take(std::size_t column) { columns.push_back(csv_.numbers(column, diagnostics_).value_or(Column{})); }
  void take_value(double value) { columns.push_back({value}); }

  const Csv& csv_;
  std::span<const std::string_view> own_;
  bool boxes_;
  Diagnostics& diagnostics_;
};

// Every row's verdict and steps, where the outputs have them.
Report report_of(const Program& program, std::span<const Column> outputs, Rows rows, std::size_t count) {
  Report report{name_of(rows), count, 0, {}, {}, {}};
  for (std::size_t i = 0; i < outputs.size(); ++i) {
    if (program.outputs[i].name == "steps") report.steps = steps_of(std::span(outputs[i]));
    if (program.outputs[i].name != "verdict") continue;
    const auto of = [&](double verdict) {
      return static_cast<std::size_t>(std::ranges::count(outputs[i], verdict));
    };
    report.verdicts = {of(verdict_hit), of(verdict_miss), of(verdict_undecided)};
  }
  return report;
}

std::optional<Csv> read_table(const std::string& path, Diagnostics& diagnostics) {
  auto text = read_text(path, diagnostics);
  if (!text) return std::nullopt;
  return Csv::parse(diagnostics.sources.add(shown_name(path), std::move(*text)), diagnostics);
}

bool run(const TableJob& job, const Options& options, Diagnostics& diagnostics) {
  Timings timings;
  const auto time = [&](const char* stage, const Stopwatch& watch) {
    timings.entries.push_back({stage, watch.milliseconds()});
  };

  const Stopwatch parsing;
  const auto model = read_model(job.file, diagnostics);
  if (!model) return false;
  time("parse", parsing);
  const auto surface = choose_surface(*model, options.surface, diagnostics);
  const auto values = uniform_values(*model, options.overrides, options.time, diagnostics);
  if (!surface || !values) return false;

  const Stopwatch reading;
  const auto csv = read_table(job.table, diagnostics);
  if (!csv) return false;
  Inputs inputs(*csv, job.rows, diagnostics);
  inputs.take_own();
  const auto names = uniform_names(*model);
  for (std::size_t i = 0; i < names.size(); ++i) inputs.take_uniform(names[i], (*values)[i]);
  if (diagnostics.has_errors()) return false;
  time("read table", reading);

  const Stopwatch building;
  const Surface& chosen = model->surfaces[*surface];
  auto program = job.program(chosen, options.wish, options.kernel.precision, diagnostics);
  if (!program) return false;
  time("build program", building);
  const auto kernel = make_kernel(std::move(*program), options.kernel, &timings);
  if (!kernel) {
    diagnostics.error(kernel.error().span, kernel.error().message);
    return false;
  }

  const Stopwatch running;
  auto outputs = csv->rows() == 0 ? std::vector<Column>((*kernel)->program().outputs.size())
                                  : run_rows(**kernel, inputs.columns, csv->rows());
  std::unique_ptr<Kernel> in_double;
  const auto method = job.method ? std::optional(job.method(chosen)) : std::nullopt;
  if (method && method->again)
    look_again(outputs, (*kernel)->program(), inputs.columns, csv->rows(), [&] {
      KernelOptions finer = options.kernel;
      finer.precision = f64;
      Diagnostics unused;
      if (auto again = job.program(chosen, second_wish(options.wish), f64, unused))
        if (auto made = make_kernel(*std::move(again), finer)) in_double = *std::move(made);
      return in_double.get();
    });
  Report report = report_of((*kernel)->program(), outputs, job.rows, csv->rows());
  if (method) report.methods = {*method};
  report.milliseconds = running.milliseconds();
  time("run", running);

  const Stopwatch writing;
  Output output;
  output.text = fmt::format("{},{}\n", csv->header_text(), fmt::join(job.columns, ","));
  for (std::size_t row = 0; row < csv->rows(); ++row) {
    output.text += csv->row_text(row);
    job.write(output.text, outputs, row);
    output.text += '\n';
    output.pass_on();
  }
  if (!output.close(diagnostics)) return false;
  time("write table", writing);
  print(report, timings, options);
  return true;
}

}  // namespace

Exit run_table(const TableJob& job, const Options& options) {
  Diagnostics diagnostics;
  const bool done = run(job, options, diagnostics);
  print(diagnostics);
  return done ? fine : failed;
}

void add_paths(CLI::App& verb, TableJob& job, const std::string& option, const std::string& help) {
  verb.add_option("F.imp", job.file, "the file with the surface")->required()->type_name("");
  add_value(verb, option, "T.csv", help, [&job](const std::string& path) { job.table = path; })->required();
  verb.final_callback([&job, option] {
    if (job.file == "-" && job.table == "-") refuse(option, "only one of two files can be standard input");
  });
}

}  // namespace imp::tools
