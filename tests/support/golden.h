// Golden files: what people read, byte for byte. IMP_UPDATE_GOLDEN=1 rewrites them, and the
// difference is part of the review.
#pragma once

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>

namespace imp::test {

// Compares `text` with tests/golden/`name`.
inline void expect_golden(const std::string& name, const std::string& text) {
  const std::filesystem::path path = std::filesystem::path(IMP_SOURCE_DIR) / "tests/golden" / name;
  if (std::getenv("IMP_UPDATE_GOLDEN") != nullptr) {
    std::filesystem::create_directories(path.parent_path());
    std::ofstream(path, std::ios::binary) << text;
    return;
  }
  std::ifstream file(path, std::ios::binary);
  ASSERT_TRUE(file) << path << " is missing; IMP_UPDATE_GOLDEN=1 writes it";
  std::ostringstream expected;
  expected << file.rdbuf();
  EXPECT_EQ(text, expected.str()) << path << " differs; IMP_UPDATE_GOLDEN=1 accepts what is new";
}

}  // namespace imp::test
