// The surfaces of the catalogue and of the examples.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <iterator>

#include "tests/frontend/parse.h"
#include "tests/support/catalogue.h"

namespace imp {
namespace {

// The surface of the entry, by its name, its domain and its values.
void expect_surface(const Model& model, const test::SurfaceEntry& entry) {
  ASSERT_EQ(model.surfaces.size(), 1u);
  EXPECT_EQ(model.surfaces[0].name, entry.id);
  EXPECT_EQ(std::holds_alternative<Sphere>(model.domain.value()), entry.domain.sphere);
  EXPECT_EQ(model.time.has_value(), entry.kind == "dynamic");

  double largest = 0;
  for (const test::ValueRecord& v : entry.values)
    if (std::isfinite(v.f)) largest = std::max(largest, std::abs(v.f));
  const auto kernel = interpret(model.surfaces[0].f);
  for (const test::ValueRecord& v : entry.values) {
    const double f = test::evaluate(*kernel, test::inputs_at(model, v))[0];
    EXPECT_TRUE(!std::isfinite(v.f) || std::abs(f - v.f) <= 1e-9 * largest) << f << ", not " << v.f;
  }
}

TEST(Catalogue, has_the_values_it_should) {
  for (const test::SurfaceEntry& entry : test::catalogue()) {
    SCOPED_TRACE(entry.id);
    expect_surface(test::parse(entry.source), entry);
  }
}

std::vector<std::filesystem::path> examples() {
  std::vector<std::filesystem::path> found;
  for (const auto& file : std::filesystem::recursive_directory_iterator(IMP_SOURCE_DIR "/examples"))
    if (file.path().extension() == ".imp") found.push_back(file.path());
  std::ranges::sort(found);
  return found;
}

std::string read(const std::filesystem::path& path) {
  std::ifstream file(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

TEST(Examples, are_right) {
  for (const auto& path : examples()) {
    SCOPED_TRACE(path);
    test::parse(read(path));
  }
}

TEST(Examples, are_the_surfaces_of_the_catalogue) {
  for (const test::SurfaceEntry& entry : test::catalogue()) {
    SCOPED_TRACE(entry.id);
    expect_surface(test::parse(read(IMP_SOURCE_DIR "/examples/surfaces/" + entry.id + ".imp")), entry);
  }
}

// Every beginning of a right text is answered.
TEST(Examples, cut_short_are_answered) {
  const std::vector<std::filesystem::path> files = examples();
  for (std::size_t i = 0; i < files.size(); i += 5) {
    const std::string text = read(files[i]);
    for (std::size_t length = 0; length < text.size(); length += 3) {
      Diagnostics diagnostics;
      const auto model = parse_model(text.substr(0, length), "cut.imp", diagnostics);
      EXPECT_EQ(model.has_value(), !diagnostics.has_errors());
    }
  }
}

}  // namespace
}  // namespace imp
