// Builds one phase of a Program.
//
//   Loop loop(program, "march", 512);
//   Expr t = loop.state("t", tmin);
//   loop.next(t, t + step);
//   loop.again_while(t < tmax);
//   Expr last = loop.result(t);        // the value after the phase
#pragma once

#include <string>

#include "ir/expr.h"
#include "ir/program.h"

namespace imp {

class Loop {
 public:
  // Appends a phase of at most `steps` steps to `program`, which must outlive the Loop. A
  // name that is taken gets a number.
  Loop(Program& program, std::string name, std::uint32_t steps);

  Expr state(std::string name, Expr init);
  Truth state(std::string name, Truth init);

  // The state's value after this step. A state without a `next` keeps its value.
  void next(Expr state, Expr value);
  void next(Truth state, Truth value);

  void enter_if(Truth condition);  // default: every lane enters
  void again_while(Truth condition);

  // The value after the phase; to be used in later phases and in outputs only.
  Expr result(Expr state) const;
  Truth result(Truth state) const;

 private:
  Id add_state(std::string name, Id init);
  void set_next(Id state, Id value);
  Id result_of(Id state) const;
  Phase& phase() const { return program_->phases[index_]; }

  Program* program_;
  std::size_t index_;
};

}  // namespace imp
