// A rule an op for reduced affine forms, for ir/replay.h. Beside its form each value has a range, an interval:
// what the rules of non-affine ops look at, what stands in where a form does not hold (a pole, an overflow), and
// what says whether f is defined and continuous.
#pragma once

#include <functional>
#include <span>
#include <vector>

#include "passes/extend/affine.h"
#include "passes/extend/inclusion.h"

namespace imp {

struct Enclosure;

struct AffineOptions {
  bool intersect = false;      // every range is intersected with that of the ops on intervals
  bool signed_errors = false;  // AF2
  std::vector<bool> forms{};   // the nodes that are to have a form; all, if empty
};

class AffineRules {
 public:
  struct Value {
    std::optional<Affine> form;  // nothing: no better than the range
    Interval range;
    Range known = everything;  // holds the values on every box
    bool narrowed = false;     // the range is that of the ops on intervals, and is worth keeping
    Possible truth;
    Value() = default;
    Value(std::optional<Affine> affine, const Interval& interval, bool narrow = false)
        : form(std::move(affine)), range(interval), narrowed(narrow) {}
    Value(const Possible& possible) : truth(possible) {}
    operator const Interval&() const { return range; }
    operator const Possible&() const { return truth; }
  };

  AffineRules(const Program& f, const InputBox& box, AffineOptions options = {});

  Value input(std::size_t i) const;
  Value truth(bool value) const;
  Value constant(const Enclosure& value) const;
  Value finished(Id id, Value value) const;

  Value add(const Value& a, const Value& b) const;
  Value sub(const Value& a, const Value& b) const;
  Value mul(const Value& a, const Value& b) const;
  Value square(const Value& a) const;
  Value div(const Value& a, const Value& b) const;
  Value fma(const Value& a, const Value& b, const Value& c) const;
  Value neg(const Value& a) const;
  Value powi(const Value& a, const Value& n) const;
  Value mod(const Value& a, const Value& b) const;

  // affine_linearize.cpp
  Value abs(const Value& a) const;
  Value min(const Value& a, const Value& b) const;
  Value max(const Value& a, const Value& b) const;
  Value sqrt(const Value& a) const;
  Value exp(const Value& a) const;
  Value log(const Value& a) const;
  Value sin(const Value& a) const;
  Value cos(const Value& a) const;
  Value cbrt(const Value& a) const;
  Value tan(const Value& a) const;
  Value asin(const Value& a) const;
  Value acos(const Value& a) const;
  Value atan(const Value& a) const;
  Value sinh(const Value& a) const;
  Value cosh(const Value& a) const;
  Value tanh(const Value& a) const;
  Value asinh(const Value& a) const;
  Value acosh(const Value& a) const;
  Value atanh(const Value& a) const;
  Value pow(const Value& a, const Value& b) const;
  Value chebyshev(const Value& a, const Value& degree, const Value& order) const;

  Value floor(const Value& a) const { return only(rules_.floor(a)); }
  Value ceil(const Value& a) const { return only(rules_.ceil(a)); }
  Value sign(const Value& a) const { return only(rules_.sign(a)); }
  Value atan2(const Value& y, const Value& x) const { return only(rules_.atan2(y, x)); }

  Value lt(const Value& a, const Value& b) const { return rules_.lt(a, b); }
  Value le(const Value& a, const Value& b) const { return rules_.le(a, b); }
  Value eq(const Value& a, const Value& b) const { return rules_.eq(a, b); }
  Value and_(const Value& a, const Value& b) const { return rules_.and_(a, b); }
  Value or_(const Value& a, const Value& b) const { return rules_.or_(a, b); }
  Value not_(const Value& a) const { return rules_.not_(a); }
  Value select(const Value& c, const Value& a, const Value& b) const;

 private:
  using Function = std::function<Interval(const Interval&)>;

  Value only(const Interval& range) const { return {std::nullopt, range}; }
  Value settled(Value value) const;
  Affine reciprocal(const Value& b) const;
  Affine power(const Affine& a, unsigned n) const;
  Affine wave(const Affine& angle, Op at, Op ahead, double sign) const;
  Value sloped(const Value& a, const Function& f, const Interval& slope) const;

  IntervalRules rules_;
  const Program& f_;
  InputBox box_;
  std::vector<std::optional<Range>> known_;
  affine::Shape shape_;
  AffineOptions options_;
};

// Of every node that has a rule, by index.
std::vector<std::optional<AffineRules::Value>> affine_nodes(const Program& f, const InputBox& box);

// The forms of the outputs of `f` over the box, with a symbol for each of its variables, in their order.
std::optional<std::vector<AffineRules::Value>> affine_values(const Program& f, const InputBox& box,
                                                             Diagnostics& diagnostics,
                                                             AffineOptions options = {});

// Their ranges.
std::optional<std::vector<Interval>> enclosures(const std::optional<std::vector<AffineRules::Value>>& values);

}  // namespace imp
