// Rays through kernels: what `imp cast` does, with rays and answers as structs.
#pragma once

#include <fmt/format.h>

#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "runtime/evaluate.h"
#include "runtime/kernel.h"
#include "runtime/numbers.h"
#include "tests/support/catalogue.h"

namespace imp::test {

struct Ray {
  std::array<double, 3> o, d;
  double tmin, tmax;
  std::optional<double> time{};  // nothing: the default
};

inline std::vector<Ray> rays_of(const SurfaceEntry& entry) {
  std::vector<Ray> rays;
  for (const RayRecord& ray : entry.rays) rays.push_back({ray.o, ray.d, ray.t0, ray.t1, ray.time});
  return rays;
}

// So that it can be read back: as a row for `imp cast`.
inline std::string to_text(const Ray& ray) {
  std::string text = fmt::format("{},{},{},{},{},{},{},{}", ray.o[0], ray.o[1], ray.o[2], ray.d[0], ray.d[1],
                                 ray.d[2], ray.tmin, ray.tmax);
  return ray.time ? text + fmt::format(", time {}", *ray.time) : text;
}

struct Answer {
  double verdict = 0, t = 0;
  std::array<double, 3> normal{};
  double steps = 0;
};

inline std::unique_ptr<Kernel> kernel_of(Program program, const KernelOptions& options) {
  auto kernel = make_kernel(std::move(program), options);
  if (!kernel) throw std::runtime_error(kernel.error().message);
  return *std::move(kernel);
}

// Casts rays at the first surface of a file.
class Caster {
 public:
  explicit Caster(const Model& model, const KernelOptions& options = {}, const SearchLimits& limits = {},
                  const std::vector<Override>& overrides = {},
                  const Inclusion& inclusion = inclusions().front(),
                  const Search& search = searches().front())
      : moves_(model.time.has_value()) {
    Diagnostics diagnostics;
    auto uniforms = uniform_values(model, overrides, std::nullopt, diagnostics);
    auto program =
        cast_program(model.surfaces.at(0), search, inclusion, limits, options.precision, diagnostics);
    if (!uniforms || !program) throw std::runtime_error(to_text(diagnostics));
    uniforms_ = *std::move(uniforms);
    kernel_ = kernel_of(*std::move(program), options);
  }

  std::vector<Answer> operator()(std::span<const Ray> rays) const {
    std::vector<Column> columns(8);
    for (const Ray& ray : rays) {
      for (std::size_t i = 0; i < 3; ++i) {
        columns[i].push_back(ray.o[i]);
        columns[3 + i].push_back(ray.d[i]);
      }
      columns[6].push_back(ray.tmin);
      columns[7].push_back(ray.tmax);
    }
    for (const double value : uniforms_) columns.push_back({value});
    if (moves_) {  // the time is the last of the uniforms
      columns.back().clear();
      for (const Ray& ray : rays) columns.back().push_back(ray.time.value_or(uniforms_.back()));
    }
    const auto out = run_rows(*kernel_, columns, rays.size());
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers.push_back({out[0][i], out[1][i], {out[2][i], out[3][i], out[4][i]}, out[5][i]});
    return answers;
  }
  const Program& program() const { return kernel_->program(); }  // as the backend runs it
  Answer operator()(const Ray& ray) const { return (*this)(std::span(&ray, 1)).front(); }

 private:
  bool moves_;
  UniformValues uniforms_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace imp::test
