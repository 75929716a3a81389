# Language, warnings, floating point and linker: the same for every target.
set(CMAKE_CXX_STANDARD 23)
set(CMAKE_CXX_STANDARD_REQUIRED ON)
set(CMAKE_CXX_EXTENSIONS OFF)
set(CMAKE_EXPORT_COMPILE_COMMANDS ON)
set(CMAKE_RUNTIME_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})  # build/<preset>/imp, the tests beside it
set(CMAKE_LIBRARY_OUTPUT_DIRECTORY ${PROJECT_BINARY_DIR})  # and imp_image.so, found beside the executable

if(NOT CMAKE_BUILD_TYPE)
  set(CMAKE_BUILD_TYPE Release)
endif()
set(CMAKE_CXX_FLAGS_RELEASE "-O2 -DNDEBUG")
set(CMAKE_CXX_FLAGS_DEBUG "-O1 -g1")

add_compile_options(-Wall -Wextra -Wpedantic -Wshadow -Wconversion -Wnon-virtual-dtor -Woverloaded-virtual -Werror)
if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # The flow analysis of gcc 12 finds faults in the inlined code of its own library (std::string, std::vector).
  add_compile_options(-Wno-restrict -Wno-stringop-overflow -Wno-stringop-overread -Wno-array-bounds -Wno-maybe-uninitialized)
endif()

if(CMAKE_CXX_COMPILER_ID STREQUAL GNU)
  # gcc 12 at -O2 turns two neighbouring double -> float -> double into nothing: no rounding to float happens
  # (docs/decisions/compilers.md). Its vectoriser of straight-line code does it.
  add_compile_options(-fno-tree-slp-vectorize)
endif()

# A fused multiply-add happens where the program says `fma`, and nowhere else.
add_compile_options(-ffp-contract=off)

# For code that computes under a rounding mode other than to nearest.
set(IMP_ROUNDING -frounding-math)

if(IMP_SANITIZE)
  # No `function`: it reads the bytes before a kernel that was just compiled.
  set(sanitize -fsanitize=${IMP_SANITIZE} -fno-sanitize=function -fno-sanitize-recover=all -fno-omit-frame-pointer)
  add_compile_options(${sanitize})
  add_compile_definitions(IMP_SANITIZED)
  add_link_options(${sanitize})
endif()

find_program(CCACHE ccache)
if(CCACHE AND NOT CMAKE_CXX_COMPILER_LAUNCHER)
  set(CMAKE_CXX_COMPILER_LAUNCHER ${CCACHE})
endif()
