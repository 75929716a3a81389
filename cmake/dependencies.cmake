# What comes from outside, and nothing of it is downloaded. tools/dev lists the packages.
find_package(fmt REQUIRED CONFIG)
find_package(glm REQUIRED CONFIG)
find_package(nlohmann_json REQUIRED CONFIG)
find_package(CLI11 REQUIRED CONFIG)
find_package(Threads REQUIRED)
find_package(LLVM 19.1 REQUIRED CONFIG)
find_package(PkgConfig REQUIRED)
pkg_check_modules(OIIO REQUIRED IMPORTED_TARGET OpenImageIO>=2.4)  # its CMake package would ask for OpenCV

# Exact constants on the host: MPFI on MPFR on GMP, static where there is a static library.
set(IMP_MPFI)
foreach(library mpfi mpfr gmp)
  find_library(IMP_${library} NAMES lib${library}.a ${library} REQUIRED)
  list(APPEND IMP_MPFI ${IMP_${library}})
endforeach()

# lld links LLVM in a second where the default linker takes many. gcc 12 knows it by this folder only.
find_program(IMP_LLD ld.lld PATHS ${LLVM_TOOLS_BINARY_DIR} NO_DEFAULT_PATH)
if(IMP_LLD)
  add_link_options(-B${LLVM_TOOLS_BINARY_DIR} -fuse-ld=lld)
endif()
