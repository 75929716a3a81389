// The options of one answer, as words on a command line; and the answers: what `imp cast` and `imp eval` do,
// with the second look.
#pragma once

#include "passes/surface_passes.h"
#include "runtime/method.h"
#include "runtime/second_look.h"
#include "tests/support/cast.h"

namespace imp::test {

struct AttackOptions {
  std::string search = "auto", inclusion = "auto";
  KernelOptions kernel{};
  bool tiles = true;
  std::string economize = "0";

  const Search* wished_search() const { return search == "auto" ? nullptr : search_named(search); }
  const Inclusion* wished_inclusion() const {
    return inclusion == "auto" ? nullptr : inclusion_named(inclusion);
  }
};

inline constexpr std::string_view backend_names[] = {"llvm", "interpreter", "glsl"};

// Those that are not the defaults, each followed by a space.
inline std::string to_text(const AttackOptions& options) {
  std::string text;
  const auto add = [&](std::string_view name, std::string_view value, std::string_view usual) {
    if (value != usual) text += fmt::format("{}={} ", name, value);
  };
  add("search", options.search, "auto"), add("inclusion", options.inclusion, "auto");
  add("precision", options.kernel.precision == f32 ? "float" : "double", "float");
  add("backend", backend_names[static_cast<std::size_t>(options.kernel.backend)], "llvm");
  add("target", options.kernel.target, "host");
  add("tiles", options.tiles ? "on" : "off", "on");
  add("economize", options.economize, "0");
  return text;
}

// Throws at what is no option.
inline void set_option(AttackOptions& options, std::string_view word) {
  const std::size_t equals = word.find('=');
  const std::string name(word.substr(0, equals));
  const std::string value(equals == std::string_view::npos ? "" : word.substr(equals + 1));
  if (name == "search")
    options.search = value;
  else if (name == "inclusion")
    options.inclusion = value;
  else if (name == "precision")
    options.kernel.precision = value == "double" ? f64 : f32;
  else if (name == "backend")
    options.kernel.backend = static_cast<Backend>(std::ranges::find(backend_names, value) - backend_names);
  else if (name == "target")
    options.kernel.target = value;
  else if (name == "tiles")
    options.tiles = value == "on";
  else if (name == "economize")
    options.economize = value;
  else
    throw std::runtime_error("no option: " + std::string(word));
}

// The kernel of these options; nothing where the way is not for the formula.
inline std::unique_ptr<Kernel> kernel_or_nothing(std::optional<Program> program,
                                                 const KernelOptions& options) {
  if (!program) return nullptr;
  auto kernel = make_kernel(*std::move(program), options);
  return kernel ? *std::move(kernel) : nullptr;
}

class FullCast {
 public:
  FullCast(const Model& model, std::size_t surface, const AttackOptions& options, UniformValues uniforms)
      : surface_(&model.surfaces.at(surface)), options_(options), uniforms_(std::move(uniforms)) {
    const Wish wish{options.wished_search(), options.wished_inclusion()};
    kernel_ = make(wish, options.kernel);
    method_ = choose_method(simplified(surface_->f), wish, options.kernel);
  }
  explicit operator bool() const { return kernel_ != nullptr; }

  std::vector<Answer> operator()(std::span<const Ray> rays) {
    std::vector<Column> columns(8);
    for (const Ray& ray : rays) {
      for (std::size_t i = 0; i < 3; ++i) columns[i].push_back(ray.o[i]), columns[3 + i].push_back(ray.d[i]);
      columns[6].push_back(ray.tmin), columns[7].push_back(ray.tmax);
    }
    for (const double value : uniforms_) columns.push_back({value});
    auto out = run_rows(*kernel_, columns, rays.size());
    if (method_->again)
      look_again(out, kernel_->program(), columns, rays.size(), [&] {
        if (!finer_) {
          KernelOptions finer = options_.kernel;
          finer.precision = f64;
          finer_ = make(second_wish({options_.wished_search(), options_.wished_inclusion()}), finer);
        }
        return finer_.get();
      });
    std::vector<Answer> answers;
    for (std::size_t i = 0; i < rays.size(); ++i)
      answers.push_back({out[0][i], out[1][i], {out[2][i], out[3][i], out[4][i]}, out[5][i]});
    return answers;
  }

 private:
  std::unique_ptr<Kernel> make(const Wish& wish, const KernelOptions& kernel) const {
    Diagnostics unused;
    const Method method = choose_method(simplified(surface_->f), wish, kernel);
    return kernel_or_nothing(
        cast_program(*surface_, *method.search, *method.inclusion, {}, kernel.precision, unused), kernel);
  }

  const Surface* surface_;
  AttackOptions options_;
  UniformValues uniforms_;
  std::optional<Method> method_;
  std::unique_ptr<Kernel> kernel_, finer_;
};

using RealBox = std::array<double, 6>;  // xlo, xhi, …
struct Enclosed {
  double lo, hi;
  bool defined;
};

class FullEval {
 public:
  FullEval(const Model& model, const AttackOptions& options, UniformValues uniforms)
      : uniforms_(std::move(uniforms)) {
    Diagnostics unused;
    const Inclusion* inclusion = inclusion_named(options.inclusion);
    kernel_ = kernel_or_nothing(evaluation_program(model.surfaces.at(0), Evaluation::interval,
                                                   options.kernel.precision, unused, inclusion),
                                options.kernel);
  }
  explicit operator bool() const { return kernel_ != nullptr; }

  std::vector<Enclosed> operator()(std::span<const RealBox> boxes) const {
    std::vector<Column> columns(6);
    for (const RealBox& box : boxes)
      for (std::size_t i = 0; i < 6; ++i) columns[i].push_back(box[i]);
    for (const double value : uniforms_) columns.insert(columns.end(), 2, Column{value});
    const auto out = run_rows(*kernel_, columns, boxes.size());
    std::vector<Enclosed> result;
    for (std::size_t i = 0; i < boxes.size(); ++i) result.push_back({out[0][i], out[1][i], out[2][i] != 0});
    return result;
  }

 private:
  UniformValues uniforms_;
  std::unique_ptr<Kernel> kernel_;
};

}  // namespace imp::test
