// Text to Programs (ir/text.h). One line, one statement; a line that is wrong is reported, and the
// next one read. What a wrong line would have defined is known but has no value, so that its users
// are not reported too.
//
//   text      = program* | (program* "stage" int int int program)*
//   program   = "program" name  ("calls" callee ("," callee)*)?  line*  "end"
//   line      = "input" ("frame" | "cell" | "ray") name ":" type
//             | "output" name "=" operand
//             | "phase" name int  (line | state)*  "end"
//             | "%" name "=" op operand*
//             | "%" name "=" "fill" type operand
//             | "%" name "=" "call" callee "." name operand*
//   state     = "state" name ":" type "=" operand | "next" name "=" operand
//             | "enter" operand | "again" operand
//   operand   = constant | "%" (int | name ("." name)?)
//   callee    = name ("@" int)?                               # the second program of that name: f@2
//   name      = word | "quoted"
#include <fmt/format.h>

#include <algorithm>
#include <unordered_map>
#include <utility>

#include "ir/spelling.h"
#include "ir/text.h"
#include "ir/text_reader.h"
#include "ir/verify.h"

namespace imp {
namespace {

using Callee = std::shared_ptr<const Program>;

class Parser : private TextReader {
 public:
  using TextReader::TextReader;

  using TextReader::ok;

  // Reads the whole text.
  void run() {
    skip_newline();
    while (token_.kind != Token::end) {
      if (token_.is("program")) {
        program();
      } else if (token_.is("stage")) {
        stage();
      } else {
        fail("expected 'program' or 'stage'");
        end_of_line();
      }
    }
    if (ok() && stage_) error(*stage_, "a stage without a program");
  }

  Callee last;
  Pipeline pipeline;
  Span first_stage;  // valid: the text is a pipeline

 private:
  // -- statements ---------------------------------------------------------------------------------

  void stage() {
    const Span at = take().span;
    if (!first_stage.valid()) first_stage = at;
    for (std::uint32_t& n : cells_) n = integer("three numbers of cells: columns, rows, slabs").value_or(1);
    check(at, std::ranges::find(cells_, 0u) == cells_.end(), "a stage without cells");
    stage_ = at;
    end_of_line();
  }

  void program() {
    names_.clear();
    in_phase_.clear();
    callees_.clear();
    phase_.reset();
    program_ = {};
    const Span at = take().span;
    program_.name = name("the program").value_or("");
    const Span whole = join(at, before_);
    end_of_line();
    for (;;) {
      if (token_.kind == Token::end || token_.is("program") || token_.is("stage")) {
        error(whole, fmt::format("program '{}' has no 'end'", program_.name));
        reported_ = false;
        return;
      }
      if (token_.is("end") && !phase_) break;
      line();
    }
    take();
    close(whole);
    end_of_line();
  }

  // Half a program is not worth a look, but it is known.
  void close(Span at) {
    Callee whole;
    if (ok()) {
      const std::string wrong = verify(program_);
      if (check(at, wrong.empty(), "program '{}' is not legal: {}", program_.name, wrong))
        whole = std::make_shared<Program>(program_);
    }
    if (std::exchange(stage_, {})) {
      if (whole) pipeline.push_back({cells_, *whole});
      return;
    }
    const std::string spelled = spell_name(program_.name);
    const unsigned count = ++called_[spelled];
    known_.emplace(count == 1 ? spelled : fmt::format("{}@{}", spelled, count), whole);
    last = whole;
  }

  void line() {
    using Statement = void (Parser::*)();
    static const std::unordered_map<std::string_view, Statement> statements{
        {"calls", &Parser::calls}, {"input", &Parser::input}, {"output", &Parser::output},
        {"phase", &Parser::phase}, {"state", &Parser::state}, {"next", &Parser::next},
        {"enter", &Parser::enter}, {"again", &Parser::again}, {"end", &Parser::end_phase},
    };
    const auto it = statements.find(token_.text);
    if (token_.is('%')) {
      definition();
    } else if (token_.kind == Token::word && it != statements.end()) {
      take();
      (this->*it->second)();
    } else {
      std::vector<std::string_view> all;
      for (const auto& [word, statement] : statements) all.push_back(word);
      fail("expected a statement" + (token_.kind == Token::word ? did_you_mean(token_.text, all) : ""));
    }
    end_of_line();
  }

  void calls() {
    do {
      const Span at = token_.span;
      const auto label = callee_label();
      if (!label) return;
      const auto it = known_.find(*label);
      if (it == known_.end())
        return error(join(at, before_), fmt::format("no program '{}' comes before this one", *label));
      callees_.emplace(*label, static_cast<std::uint32_t>(program_.callees.size()));
      program_.callees.push_back(it->second);
    } while (accept(','));
  }

  void input() {
    static constexpr std::array<std::string_view, 3> rates{"frame", "cell", "ray"};
    const auto rate = std::ranges::find(rates, token_.text);
    if (rate == rates.end()) return fail("expected 'frame', 'cell' or 'ray'");
    take();
    const Span at = token_.span;
    const auto text = name("the input");
    if (!text || !expect(':')) return;
    const auto t = type();
    if (!t) return define(spell_name(*text), at, {});
    define(spell_name(*text), at, add_input(program_, *text, *t, static_cast<Rate>(rate - rates.begin())));
  }

  void output() {
    const auto text = name("the output");
    if (!text || !expect('=')) return;
    if (const auto id = operand()) program_.outputs.push_back({*text, *id});
  }

  void phase() {
    const Span at = before_;
    const auto text = name("the phase");
    const auto steps = text ? integer("the number of steps") : std::nullopt;
    if (phase_) return error(at, "a phase within a phase; a call may hold phases of its own");
    phase_ = at;
    again_ = false;
    const Id yes = program_.graph.constant(true);
    program_.phases.push_back({text.value_or(""), {}, yes, yes, steps.value_or(1)});
  }

  void end_phase() {
    if (!again_) error(*phase_, "a phase without 'again'");
    const Phase& ended = program_.phases.back();
    for (const auto& [key, id] : std::exchange(in_phase_, {}))
      if (key.starts_with(spell_name(ended.name) + '.')) names_.insert_or_assign(key, Id{});
    for (const State& state : ended.states) names_[member(ended.name, state.name)] = state.result;
    phase_.reset();
  }

  bool inside(std::string_view statement) {
    if (!phase_) error(before_, fmt::format("'{}' outside of a phase", statement));
    return phase_.has_value();
  }

  void state() {
    if (!inside("state")) return;
    const Span at = token_.span;
    const auto text = name("the state");
    if (!text || !expect(':')) return;
    const auto t = type();
    const auto init = t && expect('=') ? operand() : std::nullopt;
    Phase& p = program_.phases.back();
    const std::string in_full = member(p.name, *text);
    if (in_phase_.contains(in_full)) return error(at, fmt::format("state '{}' is already there", *text));
    Id id;
    if (t && init &&
        check(at, program_.graph[*init].type == *t, "the start of '{}' is {}, not {}", *text,
              to_text(program_.graph[*init].type), to_text(*t))) {
      const auto place = pair_of(static_cast<std::uint32_t>(program_.phases.size() - 1),
                                 static_cast<std::uint32_t>(p.states.size()));
      id = program_.graph.leaf(Op::state, *t, place);
      p.states.push_back({*text, *t, id, program_.graph.leaf(Op::result, *t, place), *init, id});
    }
    in_phase_.emplace(in_full, id);
    if (program_.input(*text) == nullptr) in_phase_.emplace(spell_name(*text), id);
  }

  void next() {
    if (!inside("next")) return;
    const Span at = token_.span;
    const auto text = name("the state");
    if (!text) return;
    auto& states = program_.phases.back().states;
    const auto it = std::ranges::find(states, *text, &State::name);
    if (it == states.end() && in_phase_.contains(member(program_.phases.back().name, *text)))
      return skip_rest();
    if (it == states.end()) {
      std::vector<std::string_view> all;
      for (const State& one : states) all.push_back(one.name);
      return error(at, fmt::format("no state '{}' in this phase{}", *text, did_you_mean(*text, all)));
    }
    if (!expect('=')) return;
    if (const auto id = operand()) it->next = *id;
  }

  void enter() {
    if (!inside("enter")) return;
    if (const auto id = operand()) program_.phases.back().enter = *id;
  }

  void again() {
    if (!inside("again")) return;
    again_ = true;
    if (const auto id = operand()) program_.phases.back().again = *id;
  }

  void definition() {
    const Span at = take().span;
    const bool numbered = is_node_number();
    const auto text = numbered ? std::optional(std::string(take().text)) : name("the node");
    if (!text) return;
    const Span named = join(at, before_);
    const std::string key = numbered ? *text : spell_name(*text);
    if (!expect('=')) return define(key, named, {});
    const Id id = operation();
    if (id.valid()) {
      program_.graph.set_span(id, join(at, before_));
      const Node node = program_.graph[id];
      const bool folded =
          node.op == Op::constant || node.op == Op::input || node.op == Op::state || node.op == Op::result;
      if (!numbered && !folded) program_.graph.set_name(id, *text);
    }
    define(key, named, id);
  }

  // -- the right side of a definition --------------------------------------------------------------

  Id operation() {
    const Span at = token_.span;
    if (token_.kind != Token::word) return fail("expected an op"), Id{};
    const std::string_view text = take().text;
    if (text == "fill") return fill(at);
    if (text == "call") return call(at);
    const auto op = op_named(text);
    if (!op || !is_computed(*op)) {
      std::vector<std::string_view> all;
      for (int i = 0; i < op_count; ++i)
        if (is_computed(static_cast<Op>(i))) all.push_back(info(static_cast<Op>(i)).name);
      return error(at, fmt::format("unknown op '{}'{}", text, did_you_mean(text, all))), Id{};
    }
    const auto args = operands();
    if (!args) return {};
    const auto arity = static_cast<std::size_t>(info(*op).arity);
    if (!check(at, args->size() == arity, "'{}' takes {} operand{}, not {}", text, arity,
               arity == 1 ? "" : "s", args->size()))
      return {};
    std::vector<Type> types;
    for (const Id arg : *args) types.push_back(program_.graph[arg].type);
    if (!check(at, type_of(*op, types).has_value(), "'{}' does not take {}", text, list(types))) return {};
    // Folding would compute with it.
    const std::string_view wrong = wrong_integers(program_.graph, *op, *args);
    if (!check(at, wrong.empty(), "{}", wrong)) return {};
    return program_.graph.add(*op, *args);
  }

  static bool is_computed(Op op) {
    return info(op).kind != OpKind::structure || op == Op::load || op == Op::store;
  }

  Id fill(Span at) {
    const auto t = type();
    const auto value = t ? operand() : std::nullopt;
    if (!value) return {};
    const Type of = program_.graph[*value].type;
    if (!check(at, t->is_table() && of == t->element(), "'fill' of {} does not take ({})", to_text(*t),
               to_text(of)))
      return {};
    return program_.graph.fill(*t, *value);
  }

  Id call(Span at) {
    const auto label = callee_label();
    if (!label || !expect('.')) return {};
    const auto wanted = name("the output");
    const auto args = wanted ? operands() : std::nullopt;
    if (!args) return {};
    const auto it = callees_.find(*label);
    if (!check(at, it != callees_.end(), "'{}' is not among the 'calls' of this program", *label)) return {};
    if (!program_.callees[it->second]) return {};  // it has errors of its own
    const Program& callee = *program_.callees[it->second];
    const Output* output = callee.output(*wanted);
    if (!check(at, output != nullptr, "'{}' has no output '{}'", callee.name, *wanted)) return {};
    std::vector<Type> given, taken;
    for (const Id arg : *args) given.push_back(program_.graph[arg].type);
    for (const Input& one : callee.inputs) taken.push_back(one.type);
    if (!check(at, given == taken, "'{}' takes {}, not {}", callee.name, list(taken), list(given))) return {};
    return program_.graph.call(callee.graph[output->id].type, it->second,
                               static_cast<std::uint32_t>(output - callee.outputs.data()), *args);
  }

  static std::string list(const std::vector<Type>& types) {
    std::string text;
    for (const Type type : types) text += (text.empty() ? "" : ", ") + to_text(type);
    return '(' + text + ')';
  }

  // Those up to the end of the line; nothing if one has no value.
  std::optional<std::vector<Id>> operands() {
    std::vector<Id> all;
    bool whole = true;
    while (!at_end_of_line()) {
      const std::uint32_t before = token_.span.begin;
      if (const auto id = operand())
        all.push_back(*id);
      else
        whole = false;
      if (token_.span.begin == before) break;
    }
    return whole ? std::optional(std::move(all)) : std::nullopt;
  }

  std::optional<Id> operand() {
    if (token_.kind == Token::number || token_.kind == Token::word) {
      const auto literal = read_constant(token_.text);
      if (!literal) {
        const bool word = token_.kind == Token::word;
        error(token_.span,
              fmt::format(fmt::runtime(word ? "'{0}' is no constant; a name is written %{0}"
                                            : "'{0}' is no number, or beyond the range of its type"),
                          token_.text));
        take();
        return std::nullopt;
      }
      take();
      if (literal->type.is_truth()) return program_.graph.constant(literal->value != 0);
      return program_.graph.constant(literal->type, literal->value);
    }
    if (!token_.is('%')) return fail("expected an operand: %name or a constant"), std::nullopt;
    const Span at = take().span;
    std::string key;
    if (is_node_number()) {
      key = take().text;
    } else {
      const auto first = name("the operand");
      if (!first) return std::nullopt;
      key = spell_name(*first);
      if (accept('.')) {
        const auto second = name("the state");
        if (!second) return std::nullopt;
        key = member(*first, *second);
      }
    }
    return look_up(key, join(at, before_));
  }

  bool is_node_number() const {
    return token_.kind == Token::number &&
           token_.text.find_first_not_of("0123456789") == std::string_view::npos;
  }

  // -- names --------------------------------------------------------------------------------------

  static std::string member(std::string_view phase, std::string_view state) {
    return spell_name(phase) + '.' + spell_name(state);
  }

  // An invalid id: known, without a value.
  void define(const std::string& key, Span at, Id id) {
    if (in_phase_.contains(key) || !names_.emplace(key, id).second)
      error(at, fmt::format("'%{}' is already there", key));
  }

  std::optional<Id> look_up(const std::string& key, Span at) {
    for (const auto* names : {&in_phase_, &names_}) {
      const auto it = names->find(key);
      if (it == names->end()) continue;
      return it->second.valid() ? std::optional(it->second) : std::nullopt;
    }
    std::vector<std::string_view> all;
    for (const auto* names : {&in_phase_, &names_})
      for (const auto& [known, id] : *names)
        if (is_word_start(known[0]) && names->size() < 1000) all.push_back(known);
    std::ranges::sort(all);  // the same hint every time
    error(at, fmt::format("unknown name '%{}'{}", key, did_you_mean(key, all)));
    return std::nullopt;
  }

  std::optional<std::string> callee_label() {
    const auto text = name("the program");
    if (!text) return std::nullopt;
    std::string label = spell_name(*text);
    if (!accept('@')) return label;
    const auto number = integer("the number of the program");
    return number ? std::optional(fmt::format("{}@{}", label, *number)) : std::nullopt;
  }

  std::unordered_map<std::string, Callee> known_;     // programs, by label
  std::unordered_map<std::string, unsigned> called_;  // how many have a name
  std::optional<Span> stage_;                         // of the next program
  std::array<std::uint32_t, 3> cells_{};

  Program program_;  // that is being read
  std::unordered_map<std::string, std::uint32_t> callees_;
  std::unordered_map<std::string, Id> names_;     // as they are spelled
  std::unordered_map<std::string, Id> in_phase_;  // states of the current phase
  std::optional<Span> phase_;                     // where it began
  bool again_ = false;
};

}  // namespace

std::optional<Program> parse_program(std::string text, std::string name, Diagnostics& diagnostics) {
  Parser parser(diagnostics.sources.add(std::move(name), std::move(text)), diagnostics);
  parser.run();
  if (!parser.ok()) return std::nullopt;
  if (parser.first_stage.valid())
    return diagnostics.error(parser.first_stage, "a pipeline, where one program is wanted"), std::nullopt;
  if (!parser.last) return diagnostics.error("no program in the text"), std::nullopt;
  return *parser.last;
}

std::optional<Pipeline> parse_pipeline(std::string text, std::string name, Diagnostics& diagnostics) {
  Parser parser(diagnostics.sources.add(std::move(name), std::move(text)), diagnostics);
  parser.run();
  if (!parser.ok()) return std::nullopt;
  return std::move(parser.pipeline);
}

}  // namespace imp
