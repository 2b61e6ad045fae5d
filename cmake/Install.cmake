# `cmake --install build`, and `find_package(slipscale)` for programs built on the library.
include(CMakePackageConfigHelpers)

install(TARGETS slide homogenize morphology RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR})
install(TARGETS slipscale EXPORT slipscaleTargets)
install(DIRECTORY include/slipscale ${CMAKE_CURRENT_BINARY_DIR}/include/slipscale
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR})

set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slipscale)
install(EXPORT slipscaleTargets NAMESPACE slipscale:: DESTINATION ${package_dir})
configure_package_config_file(cmake/slipscaleConfig.cmake.in slipscaleConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(slipscaleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/slipscaleConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/slipscaleConfigVersion.cmake
  cmake/FindPETSc.cmake cmake/FindHDF5MPI.cmake cmake/FindMETIS.cmake cmake/FindFFTW3.cmake
  cmake/FindLibYAML.cmake
  DESTINATION ${package_dir})
