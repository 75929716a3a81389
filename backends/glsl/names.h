// Names in a shader: those the user gave, where GLSL allows them, and no two the same.
#pragma once

#include <string>
#include <string_view>
#include <unordered_set>

namespace imp {

class Names {
 public:
  // `wanted` with what GLSL forbids replaced, and with a number behind it where it is taken or reserved.
  std::string take(std::string_view wanted);

 private:
  std::unordered_set<std::string> taken_;
};

}  // namespace imp
