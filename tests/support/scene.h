// A file of the attack: parameters, the time and formulas as trees; the lines of domain and camera are left
// as they are.
#pragma once

#include <optional>

#include "runtime/numbers.h"
#include "tests/support/catalogue.h"
#include "tests/support/real_function.h"

namespace imp::test {

struct Scene {
  struct Named {
    std::string name;
    Expression value;
    bool operator==(const Named&) const = default;
  };
  std::vector<Named> params{};
  std::optional<Named> time{};
  std::vector<Expression> surfaces{};
  std::vector<std::string> view{};  // domain and camera

  bool operator==(const Scene&) const = default;
};

// As a file; or in one line, where "; " separates the statements.
inline std::string to_text(const Scene& scene, std::string_view separator = "\n") {
  std::vector<std::string> lines;
  for (const auto& [name, value] : scene.params) lines.push_back("param " + name + " = " + to_text(value));
  if (scene.time) lines.push_back("time " + scene.time->name + " = " + to_text(scene.time->value));
  const bool named = scene.surfaces.size() > 1;
  for (std::size_t i = 0; i < scene.surfaces.size(); ++i)
    lines.push_back((named ? fmt::format("surface {}: ", static_cast<char>('a' + i)) : "") +
                    to_text(scene.surfaces[i]));
  lines.insert(lines.end(), scene.view.begin(), scene.view.end());
  return fmt::format("{}", fmt::join(lines, separator));
}

inline Scene read_scene(std::string_view text) {
  Scene scene;
  while (!text.empty()) {
    const std::size_t end = std::min(text.find_first_of(";\n"), text.size());
    std::string_view line = text.substr(0, end);
    text.remove_prefix(std::min(end + 1, text.size()));
    while (line.starts_with(' ')) line.remove_prefix(1);
    if (line.empty()) continue;
    ExpressionReader reader(line);
    const std::string first(reader.peek());
    const auto named = [&] {
      reader.take();
      std::string name = reader.take();
      reader.skip("=");
      return Scene::Named{std::move(name), reader.expr()};
    };
    if (first == "param") {
      scene.params.push_back(named());
    } else if (first == "time") {
      scene.time = named();
    } else if (first == "domain" || first == "camera") {
      scene.view.emplace_back(line);
    } else {
      if (first == "surface") line.remove_prefix(line.find(':') + 1);
      ExpressionReader equation(line);
      Expression left = equation.expr();
      if (!equation.peek().empty()) {
        if (!equation.skip("=")) throw std::runtime_error("no statement: " + std::string(line));
        Expression right = equation.expr();
        if (!right.is("0", 0)) left = {"-", {left, right}};
      }
      scene.surfaces.push_back(std::move(left));
    }
  }
  return scene;
}

// What a file means, by the compiler and by the reference.
struct Meaning {
  Model model;
  std::vector<RealFunction> functions;  // a surface each, of x, y, z and the uniforms
  UniformValues uniforms;
};

// Nothing where the compiler refuses the file.
inline std::optional<Meaning> meaning_of(const Scene& scene) {
  Diagnostics diagnostics;
  auto model = parse_model(to_text(scene) + "\n", "attack.imp", diagnostics);
  if (!model) return std::nullopt;
  auto uniforms = uniform_values(*model, {}, std::nullopt, diagnostics);
  if (!uniforms) return std::nullopt;
  std::vector<std::string> names{"x", "y", "z"};
  for (const auto& param : scene.params) names.push_back(param.name);
  if (scene.time) names.push_back(scene.time->name);
  Meaning meaning{*std::move(model), {}, *std::move(uniforms)};
  for (const Expression& e : scene.surfaces) meaning.functions.emplace_back(e, names);
  return meaning;
}

}  // namespace imp::test
