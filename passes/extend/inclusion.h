// Inclusion functions (Moore 1966): enclosures of f over a box. Every form is one file with one function
// of the same signature (forms.h), and a row of the table here.
#pragma once

#include <optional>
#include <span>
#include <string_view>
#include <vector>

#include "ir/diagnostics.h"
#include "passes/extend/interval_rules.h"
#include "passes/range.h"

namespace imp {

// The box over which f is enclosed, in the graph and the type of its sides.
struct InputBox {
  std::span<const Interval> sides;         // an enclosure of each input of f, in order
  std::span<const std::size_t> variables;  // the inputs whose dependence a form looks at: x, y, z in space,
                                           // s along a ray. The others are taken as the sets they are
  std::span<const Range> domain = {};      // if given, what the sides never leave
};

// Enclosures of the outputs of `f` (f64, constants unresolved) over the box; of their facts none is
// promised. Errors point at an op for which the form has no rule.
using Form = std::optional<std::vector<Interval>>(const Program& f, const InputBox& box,
                                                  Diagnostics& diagnostics);

struct Inclusion {
  std::string_view name;
  std::string_view summary;  // one line for `imp list inclusions`
  Form* enclose;
};

std::span<const Inclusion> inclusions();
const Inclusion* inclusion_named(std::string_view name);

// For a Program with inputs x, … and outputs f, … of type f64 the Program over boxes: inputs xlo,
// xhi, … of type f64, which are narrowed outward where `type` is f32; outputs flo, fhi (f64,
// inf and -inf where empty) and fdefined (truth: defined and continuous on the whole box). Its variables
// are the inputs that change from ray to ray.
// An input that is not a box (lo > hi or NaN) has no points: the answer is empty and not defined.
std::optional<Program> extension(const Program& f, Form& form, Type type, Diagnostics& diagnostics);

}  // namespace imp
