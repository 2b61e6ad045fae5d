# HDF5 built for the MPI in use, through its pkg-config file: PETSc links this one, so must we. Target: HDF5MPI::HDF5MPI
find_package(PkgConfig REQUIRED)
pkg_search_module(HDF5MPI QUIET hdf5-openmpi hdf5-mpich hdf5)
include(FindPackageHandleStandardArgs)
find_package_handle_standard_args(HDF5MPI REQUIRED_VARS HDF5MPI_LINK_LIBRARIES VERSION_VAR HDF5MPI_VERSION)
if(HDF5MPI_FOUND AND NOT TARGET HDF5MPI::HDF5MPI)
  add_library(HDF5MPI::HDF5MPI INTERFACE IMPORTED)
  set_target_properties(HDF5MPI::HDF5MPI PROPERTIES
    INTERFACE_INCLUDE_DIRECTORIES "${HDF5MPI_INCLUDE_DIRS}"
    INTERFACE_LINK_LIBRARIES "${HDF5MPI_LINK_LIBRARIES}")
endif()
