// The attack: random files, random questions, by ways at random; every certified answer is held against what
// is proven of real numbers.
#pragma once

#include "backends/llvm/target.h"
#include "tests/support/attack_case.h"
#include "tests/support/random_scene.h"

namespace imp::test {

struct AttackCount {
  std::uint64_t tried = 0, certified = 0, right = 0, open = 0, wrong = 0;

  void add(Proof proof) {
    ++tried;
    certified += proof != Proof::undecided ? 1 : 0, right += proof == Proof::right ? 1 : 0;
    open += proof == Proof::open ? 1 : 0, wrong += proof == Proof::wrong ? 1 : 0;
  }
  void add(const AttackCount& other) {
    tried += other.tried, certified += other.certified, right += other.right;
    open += other.open, wrong += other.wrong;
  }
};

struct AttackTotal {
  std::array<AttackCount, std::size(asked_names)> by{};
  std::uint64_t scenes = 0, refused = 0;
  std::vector<AttackCase> wrong;  // the first of each kernel

  void add(const AttackTotal& other) {
    for (std::size_t i = 0; i < by.size(); ++i) by[i].add(other.by[i]);
    scenes += other.scenes, refused += other.refused;
    wrong.insert(wrong.end(), other.wrong.begin(), other.wrong.end());
  }
};

struct AttackEffort {
  std::size_t rays = 40, boxes = 60, points = 6;  // a kernel, and of each box
  std::size_t ways = 2, forms = 2;                // kernels of rays and of boxes a file
  std::size_t pictures = 12;                      // one in so many files is drawn
  std::size_t side = 12;                          // pixels
};

class Attack {
 public:
  Attack(std::uint64_t seed, const AttackEffort& effort) : seed_(seed), effort_(effort), random_(~seed) {}

  AttackTotal run() {
    RandomScenes scenes(seed_);
    scene_ = scenes.next();
    ++total_.scenes;
    const auto meaning = meaning_of(scene_);
    if (!meaning) {
      ++total_.refused;
      return std::move(total_);
    }
    meaning_ = &*meaning;
    RandomQuestions questions(seed_, scenes.aim());
    cast(questions);
    enclose(questions);
    if (scene_.surfaces.size() > 1 || random_.one_in(effort_.pictures)) draw(scenes.aim());
    return std::move(total_);
  }

 private:
  template <class Row>
  std::string any_of(const Row& rows) {
    return std::string(rows[random_.below(rows.size())].name);
  }
  AttackOptions options() {
    static const std::vector<CpuTarget> targets = [] {
      auto all = cpu_targets();
      std::erase_if(all, [](const CpuTarget& target) { return !target.runs_here; });
      return all;
    }();
    AttackOptions options;
    if (!random_.one_in(3)) options.search = any_of(searches());
    if (!random_.one_in(3)) options.inclusion = any_of(inclusions());
    options.kernel.precision = random_.one_in(3) ? f64 : f32;
    switch (random_.below(16)) {
      case 0:
      case 1:
      case 2:  options.kernel.backend = Backend::interpreter; break;
      case 3:
      case 4:  options.kernel.target = any_of(targets); break;
      case 5:  options.kernel.backend = Backend::glsl, options.kernel.precision = f32; break;
      default: break;
    }
    return options;
  }

  // Of a kernel the first wrong answer is kept.
  void count(Asked asked, Proof proof, const AttackOptions& options, bool& found,
             std::vector<double> numbers) {
    total_.by[static_cast<std::size_t>(asked)].add(proof);
    if (proof != Proof::wrong || found) return;
    found = true;
    total_.wrong.push_back({asked, std::move(numbers), options, scene_});
  }

  void cast(RandomQuestions& questions) {
    std::vector<Ray> rays(effort_.rays);
    std::vector<std::optional<RayTruth>> truths(rays.size());
    for (Ray& ray : rays) ray = questions.ray();
    for (std::size_t i = 0; i < effort_.ways; ++i) {
      const AttackOptions way = options();
      FullCast cast(meaning_->model, 0, way, meaning_->uniforms);
      if (!cast) continue;
      const std::size_t asked = way.kernel.backend == Backend::llvm ? rays.size() : rays.size() / 4;
      const auto answers = cast(std::span(rays).first(asked));
      bool found = false;
      for (std::size_t k = 0; k < asked; ++k) {
        Proof proof = Proof::undecided;
        if (answers[k].verdict != verdict_undecided) {
          if (!truths[k]) truths[k].emplace(meaning_->functions[0], rays[k], meaning_->uniforms);
          proof = proof_of(std::span(&*truths[k], 1), rays[k], answers[k]);
        }
        count(Asked::ray, proof, way, found, numbers_of(rays[k]));
      }
    }
  }

  void enclose(RandomQuestions& questions) {
    std::vector<RealBox> boxes(effort_.boxes);
    for (RealBox& box : boxes) box = questions.box();
    const RealFunction& f = meaning_->functions[0];
    for (std::size_t i = 0; i < effort_.forms; ++i) {
      AttackOptions way = options();
      way.search = "auto";
      const FullEval eval(meaning_->model, way, meaning_->uniforms);
      if (!eval) continue;
      const auto answers = eval(boxes);
      bool found = false;
      for (std::size_t k = 0; k < boxes.size(); ++k) {
        Proof worst = Proof::right;
        std::vector<double> numbers(boxes[k].begin(), boxes[k].end());
        const auto add = [&](const std::array<double, 3>& p) {
          numbers.insert(numbers.end(), p.begin(), p.end());
        };
        std::optional<std::array<double, 3>> other;
        for (std::size_t n = 0; n < effort_.points && worst != Proof::wrong; ++n) {
          const auto p = questions.inside(boxes[k]);
          const Proof proof = proof_of(f, meaning_->uniforms, p, answers[k]);
          const bool jump =
              f.jumps() && answers[k].defined && other && jumps_between(f, meaning_->uniforms, p, *other);
          worst = jump ? Proof::wrong : std::max(worst, proof);
          if (worst == Proof::wrong) add(p);
          if (jump) add(*other);
          other = p;
        }
        count(Asked::box, worst, way, found, std::move(numbers));
      }
    }
  }

  void draw(const std::array<double, 3>& aim) {
    const double distance = random_.one_in(6) ? 300 : 6;
    const double half = random_.one_in(8) ? 1000 : random_.one_in(3) ? 0.5 : 2;
    scene_.view = {
        fmt::format("domain box(({}, {}, {}), ({}, {}, {}))", aim[0] - half, aim[1] - half, aim[2] - half,
                    aim[0] + half, aim[1] + half, aim[2] + half),
        fmt::format("camera from ({}, {}, {}) to ({}, {}, {}) {}", aim[0] + distance * random_.unit(),
                    aim[1] + distance * (random_.unit() - 0.5), aim[2] + distance, aim[0], aim[1], aim[2],
                    random_.one_in(3) ? "height 2" : "fov 30")};
    const auto meaning = meaning_of(scene_);
    if (!meaning) return;
    AttackCase attack{Asked::picture, {static_cast<double>(effort_.side)}, options(), scene_};
    attack.options.tiles = !random_.one_in(3);
    if (random_.one_in(3)) attack.options.economize = "1e-6";
    bool found = false;
    for (const PixelAnswer& pixel : picture_answers(*meaning, attack))
      count(Asked::picture, proof_of_pixel(*meaning, pixel), attack.options, found, attack.numbers);
  }

  std::uint64_t seed_;
  AttackEffort effort_;
  Random random_;
  Scene scene_;
  const Meaning* meaning_ = nullptr;
  AttackTotal total_;
};

inline AttackTotal attack(std::uint64_t seed, const AttackEffort& effort = {}) {
  return Attack(seed, effort).run();
}

}  // namespace imp::test
