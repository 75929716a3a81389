// One question of the attack, as a line of text: a ray, a box or a picture, the options, and the file that is
// asked about; and whether the answer is right.
//
//   ray 0,5e6,-3,0,0,1,0,6 precision=double : z + sin(y)
//   box -1,1,0,1,0,0,-1,0.5,0 backend=glsl inclusion=ia : sqrt(x)*z/sqrt(x)        a box, and a point in it
//   picture 16 tiles=off : surface a: x; surface b: x + 0.25; camera from (-4, 0, 0) to (0, 0, 0) fov 30
#pragma once

#include "runtime/csv.h"
#include "tests/support/attack_ways.h"
#include "tests/support/picture.h"
#include "tests/support/pixel_answers.h"
#include "tests/support/ray_truth.h"
#include "tests/support/scene.h"

namespace imp::test {

enum class Asked : std::uint8_t { ray, box, picture };
inline constexpr std::string_view asked_names[] = {"ray", "box", "picture"};

struct AttackCase {
  Asked asked = Asked::ray;
  std::vector<double> numbers{};
  AttackOptions options{};
  Scene scene{};
};

inline std::string to_text(const AttackCase& attack) {
  return fmt::format("{} {} {}: {}", asked_names[static_cast<std::size_t>(attack.asked)],
                     fmt::join(attack.numbers, ","), to_text(attack.options), to_text(attack.scene, "; "));
}

inline AttackCase read_attack(std::string_view line) {
  AttackCase attack;
  const std::size_t colon = line.find(" : ");
  if (colon == std::string_view::npos) throw std::runtime_error("no ' : ' in " + std::string(line));
  attack.scene = read_scene(line.substr(colon + 3));
  std::string_view head = line.substr(0, colon);
  const auto word = [&] {
    const std::size_t end = std::min(head.find(' '), head.size());
    const std::string_view result = head.substr(0, end);
    head.remove_prefix(std::min(end + 1, head.size()));
    return result;
  };
  const auto* asked = std::ranges::find(asked_names, word());
  if (asked == std::end(asked_names))
    throw std::runtime_error("neither ray, box nor picture: " + std::string(line));
  attack.asked = static_cast<Asked>(asked - asked_names);
  for (std::string_view list = word(); !list.empty();) {
    const std::size_t end = std::min(list.find(','), list.size());
    attack.numbers.push_back(read_number(list.substr(0, end)).value());
    list.remove_prefix(std::min(end + 1, list.size()));
  }
  while (!head.empty()) set_option(attack.options, word());
  return attack;
}

inline Ray ray_of(const std::vector<double>& n) {
  return {{n[0], n[1], n[2]}, {n[3], n[4], n[5]}, n[6], n[7]};
}
inline std::vector<double> numbers_of(const Ray& r) {
  return {r.o[0], r.o[1], r.o[2], r.d[0], r.d[1], r.d[2], r.tmin, r.tmax};
}

// Of an enclosure, at a point of its box.
inline Proof proof_of(const RealFunction& f, std::span<const double> uniforms, const std::array<double, 3>& p,
                      const Enclosed& answer) {
  std::vector<RealSet> inputs;
  for (const double x : p) inputs.push_back({Real(x), Real(x)});
  for (const double x : uniforms) inputs.push_back({Real(x), Real(x)});
  const Outcome value = f(inputs);
  if (value.nowhere) return answer.defined ? Proof::wrong : Proof::right;
  if (!value.defined) return Proof::open;
  if (value.hi < Real(answer.lo) || value.lo > Real(answer.hi)) return Proof::wrong;
  return Real(answer.lo) <= value.lo && value.hi <= Real(answer.hi) ? Proof::right : Proof::open;
}

// Whether f jumps on the way from one point to another: its values stay apart down to 2^-1200 of the way,
// where the steepest slopes of numbers that a kernel knows have closed.
inline bool jumps_between(const RealFunction& f, std::span<const double> uniforms,
                          const std::array<double, 3>& p, const std::array<double, 3>& q) {
  Ray way{p, {}, 0, 1};
  for (std::size_t i = 0; i < 3; ++i) {
    way.d[i] = q[i] - p[i];
    if (!(std::abs(way.d[i]) <= 1e6)) return false;
  }
  const RealRay along(f, way, uniforms);
  const auto gap = [](const Outcome& a, const Outcome& b) {  // at least
    return std::max(add(a.lo, -b.hi, Toward::below), add(b.lo, -a.hi, Toward::below));
  };
  Real a(0), b(1);
  Outcome at_a = along(a), at_b = along(b);
  if (!at_a.defined || !at_b.defined) return false;
  const Real half = mul(gap(at_a, at_b), Real(0.25), Toward::below);
  if (half.sign() <= 0) return false;
  for (int i = 0; i < 1200; ++i) {
    const Real middle = half_way(a, b);
    const Outcome there = along(middle);
    if (!there.defined) return false;
    const bool left = gap(at_a, there) > gap(there, at_b);
    (left ? b : a) = middle;
    (left ? at_b : at_a) = there;
    if (gap(at_a, at_b) < half) return false;
  }
  return true;
}

// The pixels of a picture with their rays.
inline std::vector<PixelAnswer> picture_answers(const Meaning& meaning, const AttackCase& attack) {
  const auto side = static_cast<std::size_t>(attack.numbers.at(0));
  RenderOptions options = sized(side, side);
  options.wish = {attack.options.wished_search(), attack.options.wished_inclusion()};
  options.kernel = attack.options.kernel;
  std::vector<PixelAnswer> pixels;
  try {
    auto all = pixel_answers(meaning.model, options);
    if (!all) return {};
    pixels = *std::move(all);
  } catch (const std::runtime_error&) { return {}; }  // too long for a shader
  options.tiles = attack.options.tiles;
  if (attack.options.economize != "0") options.economize = std::stod(attack.options.economize);
  options.depth = true;
  Diagnostics unused;
  const auto renderer = Renderer::make(meaning.model, options, unused);
  if (!renderer) return {};
  const Picture picture = renderer->frame(meaning.uniforms);
  for (std::size_t i = 0; i < pixels.size(); ++i)
    pixels[i].answer.verdict = picture.verdict[i], pixels[i].answer.t = picture.depth[i];
  return pixels;
}

// Of a pixel: its ray is known to a rounding in float, so wrong is what is wrong for all rays beside it.
inline Proof proof_of_pixel(const Meaning& meaning, const PixelAnswer& pixel) {
  if (pixel.answer.verdict == verdict_undecided) return Proof::undecided;
  if (!(pixel.ray.tmin < pixel.ray.tmax))
    return pixel.answer.verdict == verdict_hit ? Proof::open : Proof::right;
  const double slack = pixel.answer.verdict == verdict_hit ? std::ldexp(pixel.answer.t, -20) : 0;
  Proof middle = Proof::wrong;
  for (bool first = true; const Ray& ray : rays_beside(pixel.ray)) {
    std::vector<RayTruth> truths;
    for (const RealFunction& f : meaning.functions) truths.emplace_back(f, ray, meaning.uniforms);
    const Proof proof = proof_of(truths, ray, pixel.answer, slack);
    if (first) middle = proof;
    first = false;
    if (proof != Proof::wrong) return middle == Proof::wrong ? Proof::open : middle;
  }
  return Proof::wrong;
}

struct Judged {
  Proof proof = Proof::undecided;
  std::string text{};  // what was answered, and what is true
};

// The answer to one question. A file or way that is refused is undecided.
inline Judged judged(const AttackCase& attack) {
  const auto meaning = meaning_of(attack.scene);
  if (!meaning || meaning->functions.empty()) return {};
  if (attack.asked == Asked::ray) {
    FullCast cast(meaning->model, 0, attack.options, meaning->uniforms);
    if (!cast) return {};
    const Ray ray = ray_of(attack.numbers);
    const Answer answer = cast(std::span(&ray, 1)).front();
    const RayTruth truth(meaning->functions[0], ray, meaning->uniforms);
    return {proof_of(std::span(&truth, 1), ray, answer),
            fmt::format("{} at {}; {}", answer.verdict, answer.t, truth.text())};
  }
  if (attack.asked == Asked::box) {
    const FullEval eval(meaning->model, attack.options, meaning->uniforms);
    if (!eval) return {};
    RealBox box{};
    std::copy_n(attack.numbers.begin(), 6, box.begin());
    const Enclosed answer = eval(std::span(&box, 1)).front();
    const auto& n = attack.numbers;
    Judged result{proof_of(meaning->functions[0], meaning->uniforms, {n.at(6), n.at(7), n.at(8)}, answer),
                  fmt::format("[{}, {}], defined {}", answer.lo, answer.hi, answer.defined)};
    if (n.size() == 12 && answer.defined &&
        jumps_between(meaning->functions[0], meaning->uniforms, {n[6], n[7], n[8]}, {n[9], n[10], n[11]}))
      result.proof = Proof::wrong, result.text += ", but f jumps";
    return result;
  }
  Judged result{Proof::right, {}};
  for (std::size_t i = 0; const PixelAnswer& pixel : picture_answers(*meaning, attack)) {
    const Proof proof = proof_of_pixel(*meaning, pixel);
    if (proof == Proof::wrong)
      return {proof, fmt::format("pixel {}: {} at {}, ray {}", i, pixel.answer.verdict, pixel.answer.t,
                                 to_text(pixel.ray))};
    if (proof != Proof::right) result.proof = proof;
    ++i;
  }
  return result;
}

inline bool is_wrong(const AttackCase& attack) {
  try {
    return judged(attack).proof == Proof::wrong;
  } catch (const std::runtime_error&) { return false; }  // the reference does not know it
}

}  // namespace imp::test
