// imp_prove: the long runs behind docs/guarantees.md, a table each.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/prove/elementary.h"

int main(int argc, char** argv) {
  CLI::App app("the long runs behind docs/guarantees.md");
  app.require_subcommand(1);
  imp::prove::ElementaryOptions elementary;
  CLI::App* verb = app.add_subcommand("elementary", "errors of the elementary functions");
  verb->add_option("--only", elementary.only, "these functions")->delimiter(',');
  verb->add_option("--stride", elementary.stride, "every so many-th float (1: all of them)")
      ->check(CLI::PositiveNumber);
  verb->add_option("--samples", elementary.samples, "random arguments, where not all are tried");
  verb->add_option("--done", elementary.done, "a folder that remembers finished rows");
  CLI11_PARSE(app, argc, argv);
  return imp::prove::elementary(elementary) ? 0 : 1;
}
