# `cmake --install build`, and `find_package(slipscale)` for programs built on the library.
#
# Two components. `slipscale`: library, headers, slide, homogenize, relocalize, modes. `morphology`: that program, its library and
# headers, which are passed on under gmsh's GNU General Public License. `cmake --install build --component slipscale`
# leaves the second out; find_package(slipscale COMPONENTS morphology) asks for it.
include(CMakePackageConfigHelpers)
set(package_dir ${CMAKE_INSTALL_LIBDIR}/cmake/slipscale)

install(TARGETS slide homogenize relocalize modes RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT slipscale)
install(TARGETS slipscale EXPORT slipscaleTargets COMPONENT slipscale)
install(DIRECTORY include/slipscale ${CMAKE_CURRENT_BINARY_DIR}/include/slipscale
        DESTINATION ${CMAKE_INSTALL_INCLUDEDIR} COMPONENT slipscale PATTERN morphology EXCLUDE PATTERN "*.md" EXCLUDE)
install(EXPORT slipscaleTargets NAMESPACE slipscale:: DESTINATION ${package_dir} COMPONENT slipscale)

install(TARGETS morphology RUNTIME DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT morphology)
install(TARGETS slipscale_morphology EXPORT slipscaleMorphologyTargets COMPONENT morphology)
install(DIRECTORY include/slipscale/morphology DESTINATION ${CMAKE_INSTALL_INCLUDEDIR}/slipscale
        COMPONENT morphology)
install(EXPORT slipscaleMorphologyTargets NAMESPACE slipscale:: DESTINATION ${package_dir} COMPONENT morphology)
install(FILES cmake/FindGmsh.cmake DESTINATION ${package_dir} COMPONENT morphology)

configure_package_config_file(cmake/slipscaleConfig.cmake.in slipscaleConfig.cmake
                              INSTALL_DESTINATION ${package_dir})
write_basic_package_version_file(slipscaleConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES
  ${CMAKE_CURRENT_BINARY_DIR}/slipscaleConfig.cmake
  ${CMAKE_CURRENT_BINARY_DIR}/slipscaleConfigVersion.cmake
  cmake/FindPETSc.cmake cmake/FindSLEPc.cmake cmake/FindHDF5MPI.cmake cmake/FindMETIS.cmake cmake/FindFFTW3.cmake
  cmake/FindLibYAML.cmake
  DESTINATION ${package_dir} COMPONENT slipscale)
