// Statements, in the order of the grammar.
#include "frontend/parser.h"

#include <fmt/format.h>

namespace imp::syntax {

Parser::Parser(const Symbols& symbols, Ast& ast, Model& model, Diagnostics& diagnostics)
    : symbols_(symbols),
      ast_(ast),
      model_(model),
      diagnostics_(diagnostics),
      text_(diagnostics.sources.text(ast.file)) {
  ast_.definitions.resize(symbols.definitions());
}

// file = { [ statement ] NEWLINE } [ statement ]
void Parser::file(std::span<const Statement> statements) {
  const std::size_t before = diagnostics_.errors();
  enough_errors_ = before + Diagnostics::limit;
  for (const Statement& one : statements) {
    statement(one);
    if (diagnostics_.errors() >= enough_errors_) return;
  }
  if (diagnostics_.errors() == before) check_surfaces();
}

// statement = import | param | time | definition | surface | solid | domain | isovalues | camera | light
//           | material | equation
void Parser::statement(const Statement& statement) {
  lexer_ = Lexer(text_, statement.begin, statement.end);
  statement_end_ = statement.end;
  previous_ = {};
  operand_end_ = ~0u;
  open_.clear();
  depth_ = 0;
  failed_ = false;
  scope_.clear();
  token_ = lexer_.next();

  switch (statement.kind) {
    case StatementKind::import:
    case StatementKind::solid:
    case StatementKind::material:   return unsupported(token_);
    case StatementKind::isovalues:  return symbols_.find(token_.text) ? equation_alone() : unsupported(token_);
    case StatementKind::param:      return param();
    case StatementKind::time:       return time();
    case StatementKind::definition: return definition();
    case StatementKind::surface:    return surface();
    case StatementKind::domain:     return domain();
    case StatementKind::camera:     return camera();
    case StatementKind::light:      return light();
    case StatementKind::equation:   return equation_alone();
  }
}

// param = "param" NAME "=" expr [ "in" "[" expr "," expr "]" ]
void Parser::param() {
  take();
  model_.parameters.push_back(uniform("parameter."));
}

// time = "time" NAME "=" expr [ "in" "[" expr "," expr "]" ]
void Parser::time() {
  if (only_once(time_, take())) model_.time = uniform("time.");
}

Parameter Parser::uniform(std::string_view prefix) {
  const Token name = expect_name("a name");
  const std::string output = fmt::format("{}{}", prefix, name.text);
  expect("=");
  declare(name);
  Parameter parameter{std::string(name.text), setting(output, true), {}, span(name)};
  if (accept("in")) {
    const Token opened = open("[");
    const Setting low = setting(output + ".min", true);
    expect(",");
    parameter.range = {low, setting(output + ".max", true)};
    close(opened);
  }
  finish();
  return parameter;
}

// definition = NAME [ "(" NAME { "," NAME } ")" ] "=" expr
void Parser::definition() {
  const Token name = take();
  const Symbol* symbol = declare(name);
  if (at("(")) {
    const Token opened = open("(");
    do {
      const Token parameter = expect_name("a name");
      if (scope_.find(parameter.text))
        error(span(parameter),
              fmt::format("{} has two parameters {}", quoted(name.text), quoted(parameter.text)));
      scope_.push(parameter.text);
    } while (accept(","));
    close(opened);
  }
  expect("=");
  const Range body = real();
  finish();
  if (symbol) ast_.definitions[symbol->index] = {name.text, symbol->arity, body, symbol->span};
}

// surface = "surface" NAME ":" equation [ "where" condition ] [ "material" NAME ]
void Parser::surface() {
  take();
  const Token name = expect_name("a name");
  expect(":");
  const auto [known, fresh] = surface_names_.try_emplace(std::string(name.text), span(name));
  if (!fresh) {
    error(span(name), fmt::format("surface {} is defined twice", quoted(name.text)));
    diagnostics_.note(known->second, "first defined here");
  }
  equation(std::string(name.text), span(name));
  if (at("where") || at("material")) unsupported(token_);
  finish();
}

void Parser::equation_alone() {
  explain_first_word();
  equation("surface", {});
  finish();
  if (failed_) return;
  const Span place = ast_.surfaces.back().span;
  if (!nameless_) {
    nameless_ = place;
    return;
  }
  error(place, "a second equation needs a name, as the first does; write 'surface NAME:' before it");
  diagnostics_.note(*nameless_, "the first is here");
}

// equation = expr [ "=" expr ]
void Parser::equation(std::string name, Span name_span) {
  const std::uint32_t begin = token_.begin;
  const Range left = real();
  const Range right = accept("=") ? real() : Range{};
  const Span whole{ast_.file, begin, previous_.end};
  if (!failed_)
    ast_.surfaces.push_back({std::move(name), left, right, name_span.valid() ? name_span : whole});
}

// domain = "domain" ( "box" "(" point "," point ")"
//                   | "sphere" "(" [ "center" ":" point "," ] "radius" ":" expr ")" )
void Parser::domain() {
  if (!only_once(domain_, take())) return;
  const bool box = take().is("box");
  const Token opened = open("(");
  if (box) {
    const Point min = point("domain.min");
    expect(",");
    model_.domain = Box{min, point("domain.max")};
  } else {
    Point center;
    if (accept("center")) {
      expect(":");
      center = point("domain.center");
      expect(",");
    } else {
      center = default_point("domain.center", {0, 0, 0});
    }
    expect("radius");
    expect(":");
    model_.domain = Sphere{center, setting("domain.radius")};
  }
  close(opened);
  finish();
}

// camera = "camera" "from" point "to" point [ "up" point ] ( "fov" expr | "height" expr )
void Parser::camera() {
  const Token keyword = take();
  if (!only_once(camera_, keyword)) return;
  Camera camera;
  expect("from");
  camera.from = point("camera.from");
  expect("to");
  camera.to = point("camera.to");
  camera.up = accept("up") ? point("camera.up") : default_point("camera.up", {0, 1, 0});
  if (accept("fov"))
    camera.fov = setting("camera.fov");
  else if (accept("height"))
    camera.height = setting("camera.height");
  else if (at_end())
    fail(span(keyword), "a camera needs 'fov' (in degrees) or 'height' (of the picture, orthographic)");
  else
    unexpected("'fov' or 'height'");
  finish();
  model_.camera = camera;
}

// light = "light" ( "from" point | "direction" point ) [ "color" point ] [ "intensity" expr ]
void Parser::light() {
  take();
  const std::string name = fmt::format("light{}.", model_.lights.size() + 1);
  Light light;
  light.directional = take().is("direction");
  light.place = point(name + (light.directional ? "direction" : "from"));
  light.color = accept("color") ? point(name + "color") : default_point(name + "color", {1, 1, 1});
  light.intensity =
      accept("intensity") ? setting(name + "intensity") : default_setting(name + "intensity", 1);
  finish();
  model_.lights.push_back(light);
}

// point = "(" expr "," expr "," expr ")"
Point Parser::point(const std::string& name) {
  const auto comma = [&] {
    if (at(")")) fail(span(token_), "a point has 3 coordinates");
    expect(",");
  };
  const Token opened = open("(");
  Point point;
  point[0] = setting(name + ".x");
  comma();
  point[1] = setting(name + ".y");
  comma();
  point[2] = setting(name + ".z");
  close(opened);
  return point;
}

Point Parser::default_point(const std::string& name, std::array<std::uint32_t, 3> values) {
  return {default_setting(name + ".x", values[0]), default_setting(name + ".y", values[1]),
          default_setting(name + ".z", values[2])};
}

Setting Parser::setting(std::string name, bool constant) {
  const Range value = real();
  ast_.settings.push_back({std::move(name), value, constant});
  const Span place = value.begin < value.end ? ast_.span(ast_.nodes[value.end - 1]) : Span{};
  return {static_cast<std::uint32_t>(ast_.settings.size() - 1), place};
}

Setting Parser::default_setting(std::string name, std::uint32_t value) {
  const std::uint32_t begin = emit(NodeKind::integer, Op::constant, value, {});
  ast_.settings.push_back({std::move(name), {begin, node_count()}, true});
  return {static_cast<std::uint32_t>(ast_.settings.size() - 1), {}};
}

}  // namespace imp::syntax
