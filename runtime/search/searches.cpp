// The list of strategies.
#include <algorithm>
#include <array>

#include "runtime/search/search.h"

namespace imp {

std::span<const Search> searches() {
  static constexpr std::array list{
      Search{"stackless", "interval bisection without a stack, lanes independent (Knoll et al. 2009)",
             stackless},
  };
  return list;
}

const Search* search_named(std::string_view name) {
  const auto list = searches();
  const auto it = std::ranges::find(list, name, &Search::name);
  return it == list.end() ? nullptr : &*it;
}

}  // namespace imp
