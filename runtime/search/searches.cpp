// The list of strategies.
#include <algorithm>
#include <array>

#include "runtime/search/search.h"

namespace imp {

std::span<const Search> searches() {
  static constexpr std::array list{
      Search{"stackless", "interval bisection without a stack, lanes independent (Knoll et al. 2009)",
             stackless},
      Search{"isolate", "pieces on which df/ds excludes 0, and the signs at their ends", isolate},
      Search{"bernstein",
             "sign variations of Bernstein coefficients, for polynomials (Seland and Dokken 2007)", bernstein,
             true},
      Search{"polynomial", "between the critical points, by those of the derivatives (Yuksel 2022)",
             polynomial, true},
      Search{"segment", "steps by the slopes of the piece ahead (Galin et al. 2020)", segment_tracing},
      Search{"newton", "interval Newton with division through zero as two half-lines (Caprani et al. 2000)",
             newton},
  };
  return list;
}

const Search* search_named(std::string_view name) {
  const auto list = searches();
  const auto it = std::ranges::find(list, name, &Search::name);
  return it == list.end() ? nullptr : &*it;
}

}  // namespace imp
