#include "runtime/search/parts/pieces.h"

namespace imp {
namespace {

// One entry more, to be written to where nothing is pushed.
Expr table_of_places(Program& program, Expr like, std::uint32_t capacity) {
  return {&program.graph, program.graph.fill(table_of(like.type(), capacity + 1), zero(like).id)};
}

}  // namespace

Pieces::Pieces(Program& program, Loop& loop, Expr like, std::uint32_t capacity)
    : loop_(loop),
      capacity_(capacity),
      depth_(loop.state("kept", zero(like))),
      starts_(loop.state("starts", table_of_places(program, like, capacity))),
      ends_(loop.state("ends", table_of_places(program, like, capacity))) {}

Truth Pieces::any() const { return depth_ > 0; }

Expr Pieces::start() const { return select(any(), make(Op::load, starts_, depth_ - 1.0), one(depth_)); }

Expr Pieces::end() const { return select(any(), make(Op::load, ends_, depth_ - 1.0), one(depth_)); }

void Pieces::next(Truth push, Truth pop, Expr start, Expr end) {
  const Truth full = depth_ >= capacity_;
  const Expr top = select(push && full, depth_ - 1.0, depth_);
  loop_.next(starts_, make(Op::store, starts_, top, start));
  loop_.next(ends_, make(Op::store, ends_, depth_, end));  // where it is full, the top keeps its end
  loop_.next(depth_, select(push && !full, depth_ + 1.0, select(pop, depth_ - 1.0, depth_)));
}

}  // namespace imp
