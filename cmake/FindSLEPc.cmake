# SLEPc on the real-valued PETSc, through its pkg-config file. Imported target: SLEPc::SLEPc
find_package(PkgConfig REQUIRED)
find_package(PETSc REQUIRED)
pkg_check_modules(SLEPC QUIET slepc)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(SLEPc REQUIRED_VARS SLEPC_LINK_LIBRARIES VERSION_VAR SLEPC_VERSION)
if(SLEPc_FOUND AND NOT TARGET SLEPc::SLEPc)
  add_library(SLEPc::SLEPc INTERFACE IMPORTED)
  # Only where to find it: the distribution's own hardening flags are not ours to inherit.
  set_target_properties(SLEPc::SLEPc PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${SLEPC_INCLUDE_DIRS}"
    INTERFACE_LINK_LIBRARIES "${SLEPC_LINK_LIBRARIES};PETSc::PETSc")
endif()
