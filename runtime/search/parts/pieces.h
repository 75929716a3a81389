// Pieces of a ray that are still to be searched, nearest first: a stack of bounded depth.
#pragma once

#include <cstdint>

#include "ir/loop.h"

namespace imp {

// Part of the state of a phase. Pieces are disjoint and ascend from the top. Where the stack is full a piece that is
// pushed becomes one with the piece on top, and with what lies between them: nothing is lost but knowledge.
class Pieces {
 public:
  Pieces(Program& program, Loop& loop, Expr like, std::uint32_t capacity);

  Truth any() const;
  Expr start() const;  // of the piece on top; the end of the segment where there is none
  Expr end() const;

  // In this step [start, end] is pushed, or the piece on top is taken away, or neither.
  void next(Truth push, Truth pop, Expr start, Expr end);

 private:
  Loop& loop_;
  double capacity_;
  Expr depth_, starts_, ends_;
};

}  // namespace imp
