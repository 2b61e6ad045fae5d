# slipscale_test(<name> SOURCES a.cpp … RANKS 1 2 3 LABELS unit [TIMEOUT seconds])
#
# A GoogleTest executable that ctest runs once for each stated number of MPI ranks. The shared main() starts
# MPI and PETSc, prints on rank 0 and fails when any rank fails.
include(${CMAKE_CURRENT_LIST_DIR}/MpiEnvironment.cmake)

function(slipscale_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;RANKS;LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE slipscale_test_support)
  foreach(ranks IN LISTS arg_RANKS)
    add_test(NAME ${name}.np${ranks}
             COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${name}>)
    set_tests_properties(${name}.np${ranks} PROPERTIES
      LABELS "${arg_LABELS}" PROCESSORS ${ranks} TIMEOUT ${arg_TIMEOUT}
      ENVIRONMENT "${SLIPSCALE_MPI_ENVIRONMENT}")
  endforeach()
endfunction()
