// imp eval: a surface's f, its derivatives or its enclosures, for a table of points or boxes.
#include <algorithm>

#include "runtime/evaluate.h"
#include "tools/rows.h"

namespace imp::tools {
namespace {

std::vector<std::string_view> columns_of(Evaluation evaluation) {
  switch (evaluation) {
    case Evaluation::f:        return {"f"};
    case Evaluation::gradient: return {"f", "fx", "fy", "fz"};
    case Evaluation::hessian:  return {"f", "fx", "fy", "fz", "fxx", "fxy", "fxz", "fyy", "fyz", "fzz"};
    default:                   return {"lo", "hi", "defined"};
  }
}

void write_rows(std::string& text, std::span<const Column> outputs, std::size_t row) {
  for (const Column& column : outputs) {
    text += ',';
    append_number(text, column[row]);
  }
}

struct Eval {
  Options options;
  Evaluation evaluation = Evaluation::f;
  TableJob job;

  Exit run() {
    job.rows = over_boxes(evaluation) ? Rows::boxes : Rows::points;
    job.columns = columns_of(evaluation);
    job.write = write_rows;
    job.program = [this](const Surface& surface, const Wish&, Type precision, Diagnostics& diagnostics) {
      return evaluation_program(surface, evaluation, precision, diagnostics, options.named_inclusion);
    };
    return run_table(job, options);
  }
};

}  // namespace

Action add_eval(CLI::App& verb) {
  auto eval = std::make_shared<Eval>();
  add_paths(verb, eval->job, "--points",
            "points (x,y,z) or boxes (xlo,xhi,ylo,yhi,zlo,zhi), with a header line");
  add_choice(verb, "--program", evaluations(), "what is evaluated", [=](std::size_t i) {
    eval->evaluation = *evaluation_named(evaluations()[i].name);
  })->required();
  add_options(verb, eval->options);
  return [eval] { return eval->run(); };
}

}  // namespace imp::tools
