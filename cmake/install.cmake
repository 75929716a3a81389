# The package: find_package(imp), then link imp::imp_runtime, or less.
include(CMakePackageConfigHelpers)
set(package lib/cmake/imp)
install(DIRECTORY ir frontend passes backends runtime DESTINATION include/imp
  FILES_MATCHING PATTERN "*.h" PATTERN "*.def" PATTERN image EXCLUDE)
install(DIRECTORY examples/surfaces DESTINATION share/imp)
install(EXPORT imp NAMESPACE imp:: DESTINATION ${package} FILE imp-targets.cmake)
install(FILES cmake/imp-config.cmake DESTINATION ${package})
write_basic_package_version_file(${PROJECT_BINARY_DIR}/imp-config-version.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${PROJECT_BINARY_DIR}/imp-config-version.cmake DESTINATION ${package})
