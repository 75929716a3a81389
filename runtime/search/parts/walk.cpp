// What is left of the segment, [s, 1], is known by its coefficients. A step splits it by de Casteljau's algorithm into
// the piece that it looks at and the rest:
//
//    no change of sign, and none is 0 at an end:    excluded; the rest is what is left
//    one change, between proven signs at the ends:  one root, and so the first
//    else:                                          the piece is halved; what is left stays
//
// So there is no stack and no tree, and no coefficient is computed twice. After two excluded pieces the next one is
// twice as long. A doubtful piece as short as epsilon is left behind as part of a run, which ends at the first
// place where f has a proven sign: the last coefficient of a piece is f there.
#include "runtime/search/parts/walk.h"

#include "ir/loop.h"
#include "passes/polynomial/de_casteljau.h"
#include "passes/polynomial/sign_variations.h"
#include "runtime/search/parts/proven.h"
#include "runtime/search/parts/run.h"

namespace imp {
namespace {

constexpr std::uint32_t highest_float_degree = 6;

// A number of the kernel's type that is not above a place known in f64, up to the rounding of some thousand steps. Both
// ends of a run are moved down: the last piece before it is excluded, but right behind it another root may lie.
constexpr double place_error = 0x1p-38;
Expr below(Expr s, Type type) {
  const Expr lower = min(place_error - s, zero(s));
  return -(type == f32 ? narrow_up(lower) : lower);
}

// A share in (0, 1] near `wanted`, such that 1 - share is exact.
Expr exact_share(Expr wanted) {
  const double grid = wanted.type() == f32 ? 0x1p24 : 0x1p40;
  const Expr share = max(floor(wanted * grid), one(wanted)) * (1 / grid);
  return select(wanted < 0.999, share, one(wanted));
}

// The first of `places` that is well beyond s.
Expr next_place(const std::vector<Expr>& places, Expr s) {
  Expr next = one(s);
  for (std::size_t i = places.size(); i-- > 0;) {
    const Expr place = to(f64, places[i]);
    next = select(place > s + 0x1p-16, place, next);
  }
  return next;
}

// From the coefficients over the whole segment.
Found walk_from(Program& program, const RayFunction& f, std::span<const Interval> coefficients,
                const SearchLimits& limits, const std::vector<Expr>& places) {
  const Type type = f.like.type();
  const Type inner = coefficients[0].hi.type();
  const double epsilon = epsilon_of(limits, inner);
  const Expr one_{&program.graph, program.graph.constant(f64, 1)}, zero_ = zero(one_);
  const Expr unknown{&program.graph, program.graph.constant(type, 0)};
  const Truth no = truth_of(program.graph, false);
  Truth defined = truth_of(program.graph, true), ordered = defined, smooth = defined;
  for (const Interval& b : coefficients) {
    defined = defined && !b.empty;
    ordered = ordered && is_ordered(b);  // and so are all that a split makes of them
    smooth = smooth && b.continuous;
  }

  Loop loop(program, "walk", limits.steps);
  const Expr s = loop.state("s", zero_);              // what is left is [s, 1]
  const Expr h = loop.state("h", one_);               // the piece to look at is so long, at most
  const Truth calm = loop.state("calm", no);          // the last piece was excluded
  const Truth open = loop.state("open", no);          // in a run
  const Expr run = loop.state("run", zero_);          // where it began
  const Expr before = loop.state("before", unknown);  // the sign of f there
  const Expr after = loop.state("after", unknown);    // and where it ended
  const Truth single = loop.state("single", no);      // it has one root
  const Expr steps = loop.state("steps", unknown);
  std::vector<Interval> rest;
  for (std::size_t i = 0; i < coefficients.size(); ++i) {
    const std::string name = "b" + std::to_string(i);
    const Expr lower = loop.state("n" + name, coefficients[i].nlo);
    rest.push_back(interval(lower, loop.state(name, coefficients[i].hi)));
  }

  const Expr left = 1.0 - s;
  const Expr wanted = min(h, next_place(places, s) - s);
  const Expr share = exact_share(to(inner, wanted) / to(inner, left));
  const Expr length = to(f64, share) * left;
  const Expr end = select(share < 1, s + length, one_);
  const Halves parts = split_at(rest, share, 1.0 - share);

  const Expr variations = most_sign_variations(parts.left);
  const Expr at_start = to(type, proven_sign(parts.left.front()));
  const Expr at_end = to(type, proven_sign(parts.left.back()));
  const Truth excluded = variations < 0.5 && at_start * at_end > 0;
  const Truth one_root = variations < 1.5 && at_start * at_end < 0;
  const Truth doubtful = !excluded && !one_root;
  const Truth split = doubtful && length > epsilon;
  const Truth in_run = one_root || (doubtful && !split);
  const Expr run_start = select(open, run, s);
  const Truth run_ends = in_run && (!equal(at_end, unknown) || end - run_start > longest_run(epsilon));

  loop.next(s, select(split, s, end));
  loop.next(h, select(split, 0.5 * length, select(excluded && calm, 2.0 * h, h)));
  loop.next(calm, excluded);
  loop.next(open, open || in_run);
  loop.next(run, select(in_run, run_start, run));
  loop.next(before, select(in_run && !open, at_start, before));
  loop.next(after, select(in_run, at_end, after));
  loop.next(single, one_root);
  loop.next(steps, steps + 1.0);
  for (std::size_t i = 0; i < rest.size(); ++i) {
    loop.next(rest[i].nlo, select(split, rest[i].nlo, parts.right[i].nlo));
    loop.next(rest[i].hi, select(split, rest[i].hi, parts.right[i].hi));
  }
  loop.enter_if(f.exists && defined && ordered);
  loop.again_while((split || end < 1) && !run_ends);

  const Truth found = loop.result(open);
  return answer(f,
                {.found = found,
                 .a = below(loop.result(run), type),
                 .b = below(loop.result(s), type),
                 .before = loop.result(before),
                 .after = loop.result(after),
                 .smooth = smooth,
                 .single = loop.result(single)},
                !defined || (!found && loop.result(s) >= 1), loop.result(steps));
}

}  // namespace

std::optional<Found> walk(Program& program, const RayFunction& f, const SearchLimits& limits,
                          Diagnostics& diagnostics, const Proposals& proposals) {
  const auto degree = f.degree(diagnostics);
  if (!degree) return std::nullopt;
  const Type type = f.like.type(), inner = degree->degree <= highest_float_degree ? type : f64;
  const Expr start{&program.graph, program.graph.constant(inner, 0)};
  const Interval whole = interval(start, one(start), {.nonnegative = true, .bounded = true});
  const auto coefficients = f.coefficients(whole, diagnostics);
  if (!coefficients) return std::nullopt;
  const auto places = proposals ? proposals(*coefficients) : std::vector<Expr>{};
  return walk_from(program, f, *coefficients, limits, places);
}

}  // namespace imp
