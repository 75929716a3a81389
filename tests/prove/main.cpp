// imp_prove: the long runs behind docs/guarantees.md, a table each.
#include <CLI/CLI.hpp>
#include <cstdio>

#include "tests/prove/attack.h"
#include "tests/prove/bernstein.h"
#include "tests/prove/elementary.h"
#include "tests/prove/hostile.h"
#include "tests/prove/inclusions.h"
#include "tests/prove/itf1788.h"
#include "tests/prove/pictures.h"
#include "tests/prove/searches.h"
#include "tests/prove/surfaces.h"

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

  imp::prove::ItfOptions vectors;
  CLI::App* itf1788 = app.add_subcommand("itf1788", "the test vectors of IEEE 1788");
  itf1788->add_option("--vectors", vectors.vectors, "a file of vectors (tools/convert_itf1788.py)");
  itf1788->add_option("--done", "of no use here: it takes a second");

  imp::prove::InclusionOptions inclusions;
  CLI::App* enclosures = app.add_subcommand("inclusions", "every op in every form on random boxes");
  enclosures->add_option("--only", inclusions.only, "these ops")->delimiter(',');
  enclosures->add_option("--samples", inclusions.samples, "boxes a form");
  enclosures->add_option("--done", inclusions.done, "a folder that remembers finished rows");

  imp::prove::SearchOptions searches;
  CLI::App* rays = app.add_subcommand("searches", "every strategy on random rays at the catalogue");
  rays->add_option("--only", searches.only, "these surfaces")->delimiter(',');
  rays->add_option("--strategies", searches.strategies, "these strategies")->delimiter(',');
  rays->add_option("--inclusions", searches.inclusions, "with these inclusions")->delimiter(',');
  rays->add_option("--samples", searches.rays, "rays a surface")->check(CLI::PositiveNumber);
  rays->add_option("--done", searches.done, "a folder that remembers what is finished");

  imp::prove::SurfaceOptions surfaces;
  const auto add_surfaces = [&](const char* name, const char* summary) {
    CLI::App* command = app.add_subcommand(name, summary);
    command->add_option("--only", surfaces.only, "these surfaces")->delimiter(',');
    command->add_option("--samples", surfaces.samples, "boxes a surface and form");
    command->add_option("--done", surfaces.done, "a folder that remembers finished rows");
    return command;
  };
  CLI::App* catalogue = add_surfaces("surfaces", "the catalogue in every form on random boxes");
  CLI::App* tightness = add_surfaces("tightness", "widths of the forms beside the range");

  imp::prove::BernsteinOptions bernstein;
  CLI::App* ways = app.add_subcommand("bernstein", "the ways to Bernstein coefficients along a ray");
  ways->add_option("--only", bernstein.only, "these surfaces")->delimiter(',');
  ways->add_option("--done", bernstein.done, "a folder that remembers finished rows");

  imp::prove::HostileOptions hostile;
  CLI::App* input = app.add_subcommand("hostile", "input of every kind that imp did not ask for");
  input->add_option("--minutes", hostile.minutes, "how long");
  input->add_option("--seed", hostile.seed, "of what is tried");
  input->add_option("--done", "of no use here: no case is like another");

  imp::prove::AttackTableOptions attack;
  CLI::App* attacks = app.add_subcommand("attack", "certified answers about random formulas, against proofs");
  attacks->add_option("--minutes", attack.minutes, "how long; without it --rounds says how much");
  attacks->add_option("--rounds", attack.rounds, "random files");
  attacks->add_option("--seed", attack.seed, "of what is random");
  attacks->add_option("--shrink", attack.shrink, "tries to make shorter what is answered wrong");
  attacks->add_option("--done", "of no use here: there are no rows to remember");
  CLI11_PARSE(app, argc, argv);

  bool hold = true;
  if (*errors) hold = imp::prove::elementary(elementary);
  if (*shaders) hold = imp::prove::pictures(pictures);
  if (*input) hold = imp::prove::hostile(hostile);
  if (*itf1788) hold = imp::prove::itf1788(vectors);
  if (*enclosures) hold = imp::prove::inclusions(inclusions);
  if (*rays) hold = imp::prove::searches(searches);
  if (*catalogue) hold = imp::prove::surfaces(surfaces);
  if (*ways) hold = imp::prove::bernstein(bernstein);
  if (*attacks) hold = imp::prove::attack(attack);
  if (*tightness) hold = imp::prove::tightness(surfaces);
  return hold ? 0 : 1;
}
