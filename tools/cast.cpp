// imp cast: the first hit of every ray of a table.
#include <array>
#include <cmath>

#include "passes/surface_passes.h"
#include "runtime/evaluate.h"
#include "tools/rows.h"

namespace imp::tools {
namespace {

std::string_view word(double verdict) {
  return verdict == verdict_hit ? "hit" : verdict == verdict_miss ? "miss" : "undecided";
}

// What was not found is an empty cell.
void write(std::string& text, std::span<const Column> outputs, std::size_t row) {
  text += ',';
  text += word(outputs[0][row]);
  for (const Column& column : outputs.subspan(1)) {
    text += ',';
    if (!std::isnan(column[row])) append_number(text, column[row]);
  }
}

struct Cast {
  Options options;
  TableJob job;

  Exit run() {
    job.rows = Rows::rays;
    job.columns = {"verdict", "t", "nx", "ny", "nz", "steps"};
    job.write = write;
    const auto method_for = [this](const Surface& surface, const Wish& wish) {
      return choose_method(simplified(surface.f), wish, options.kernel);
    };
    job.method = [this, method_for](const Surface& surface) { return method_for(surface, options.wish); };
    job.program = [this, method_for](const Surface& surface, const Wish& wish, Type precision,
                                     Diagnostics& diagnostics) {
      if (const auto why = far_too_long_to_search(simplified(surface.f), options.kernel)) {
        diagnostics.error(surface.span, why->message);
        return std::optional<Program>();
      }
      const Method method = method_for(surface, wish);
      return cast_program(surface, *method.search, *method.inclusion, options.limits, precision, diagnostics);
    };
    return run_table(job, options);
  }
};

}  // namespace

Action add_cast(CLI::App& verb) {
  auto cast = std::make_shared<Cast>();
  add_paths(verb, cast->job, "--rays", "rays (ox,oy,oz,dx,dy,dz,tmin,tmax), with a header line");
  add_options(verb, cast->options);
  return [cast] { return cast->run(); };
}

}  // namespace imp::tools
