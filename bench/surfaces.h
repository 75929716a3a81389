// What the benchmarks draw: surfaces of examples/surfaces by name.
#pragma once

#include <memory>
#include <string>

#include "frontend/model.h"
#include "runtime/render.h"

namespace imp::bench {

// The example of this name, and a renderer for it. Ends the program where there is none.
struct Scene {
  std::unique_ptr<Model> model;
  std::unique_ptr<Renderer> renderer;
  UniformValues uniforms;
};

Model example(const std::string& name);
std::vector<std::string> example_names();  // in the order of the alphabet
Scene scene(const std::string& name, const RenderOptions& options);

// The surfaces of Knoll et al. 2009, Table 1, that are polynomials.
inline constexpr const char* knoll_table_1[] = {"sphere",       "steiner", "mitchell", "teardrop",
                                                "klein_bottle", "tangle",  "decocube", "barth_sextic",
                                                "barth_decic",  "bretzel4"};

}  // namespace imp::bench
