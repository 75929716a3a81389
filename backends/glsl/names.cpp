#include "backends/glsl/names.h"

#include <algorithm>
#include <array>

namespace imp {
namespace {

// Keywords, words kept for later, and the functions that the emitter calls. Of the opaque types and of the
// vectors and matrices see `is_type`.
constexpr std::array reserved{"abs",
                              "active",
                              "asm",
                              "attribute",
                              "bool",
                              "break",
                              "buffer",
                              "case",
                              "cast",
                              "ceil",
                              "centroid",
                              "class",
                              "coherent",
                              "common",
                              "const",
                              "continue",
                              "default",
                              "discard",
                              "do",
                              "double",
                              "else",
                              "enum",
                              "extern",
                              "external",
                              "false",
                              "filter",
                              "fixed",
                              "flat",
                              "float",
                              "floor",
                              "fma",
                              "for",
                              "goto",
                              "half",
                              "highp",
                              "if",
                              "in",
                              "inline",
                              "inout",
                              "input",
                              "int",
                              "interface",
                              "invariant",
                              "isnan",
                              "layout",
                              "long",
                              "lowp",
                              "main",
                              "mediump",
                              "min",
                              "namespace",
                              "noinline",
                              "noperspective",
                              "out",
                              "output",
                              "partition",
                              "patch",
                              "precise",
                              "precision",
                              "public",
                              "readonly",
                              "resource",
                              "restrict",
                              "return",
                              "sample",
                              "shared",
                              "short",
                              "sizeof",
                              "smooth",
                              "sqrt",
                              "static",
                              "struct",
                              "subroutine",
                              "superp",
                              "switch",
                              "template",
                              "this",
                              "true",
                              "typedef",
                              "uint",
                              "uniform",
                              "union",
                              "unsigned",
                              "using",
                              "varying",
                              "void",
                              "volatile",
                              "while",
                              "writeonly",
                              "findMSB",
                              "floatBitsToUint",
                              "intBitsToFloat",
                              "packDouble2x32",
                              "uintBitsToFloat",
                              "unpackDouble2x32",
                              "floatBitsToInt"};

bool is_type(std::string_view name) {
  if (name == "atomic_uint") return true;
  constexpr std::array families{"sampler", "isampler", "usampler", "image", "iimage", "uimage", "vec", "ivec",
                                "uvec",    "bvec",     "dvec",     "hvec",  "fvec",   "mat",    "dmat"};
  return std::ranges::any_of(families,
                             [&](std::string_view family) {
                               return name.starts_with(family) && name.size() > family.size() &&
                                      name[family.size()] >= '1' && name[family.size()] <= '4';
                             }) ||
         name == "samplerCube" || name.starts_with("samplerCube") || name.ends_with("samplerBuffer") ||
         name.ends_with("imageBuffer") || name.ends_with("imageCube");
}

// Letters, digits and single underscores, not one of them in front nor "gl_".
std::string legal(std::string_view wanted) {
  std::string name;
  for (const char c : wanted) {
    const bool letter = (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
    const bool digit = c >= '0' && c <= '9';
    if (digit && name.empty()) name = "n";
    if (letter || digit)
      name += c;
    else if (!name.empty() && name.back() != '_')
      name += '_';
  }
  while (name.ends_with('_')) name.pop_back();
  if (name.empty()) return "v";
  return name.starts_with("gl_") ? "my_" + name : name;
}

}  // namespace

std::string Names::take(std::string_view wanted) {
  const std::string base = legal(wanted);
  const bool refused = std::ranges::find(reserved, base) != reserved.end() || is_type(base);
  std::string name = base;
  for (int n = 2; (refused && name == base) || !taken_.insert(name).second; ++n)
    name = base + "_" + std::to_string(n);
  return name;
}

}  // namespace imp
