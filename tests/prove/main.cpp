// imp_prove: the long runs behind docs/guarantees.md, a table each.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/prove/elementary.h"
#include "tests/prove/pictures.h"

int main(int argc, char** argv) {
  CLI::App app("the long runs behind docs/guarantees.md");
  app.require_subcommand(1);
  imp::prove::ElementaryOptions elementary;
  CLI::App* errors = app.add_subcommand("elementary", "errors of the elementary functions");
  errors->add_option("--only", elementary.only, "these functions")->delimiter(',');
  errors->add_option("--stride", elementary.stride, "every so many-th float (1: all of them)")
      ->check(CLI::PositiveNumber);
  errors->add_option("--samples", elementary.samples, "random arguments, where not all are tried");
  errors->add_option("--done", elementary.done, "a folder that remembers finished rows");

  imp::prove::PictureOptions pictures;
  CLI::App* shaders = app.add_subcommand("pictures", "pictures by shaders beside those by machine code");
  shaders->add_option("--only", pictures.only, "these surfaces")->delimiter(',');
  shaders->add_option("--size", pictures.size, "pixels a side")->check(CLI::PositiveNumber);
  shaders->add_option("--done", pictures.done, "a folder that remembers finished rows");
  CLI11_PARSE(app, argc, argv);

  const bool hold = *errors ? imp::prove::elementary(elementary) : imp::prove::pictures(pictures);
  return hold ? 0 : 1;
}
