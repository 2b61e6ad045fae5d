# Labels say when ctest runs a test: `nightly` and `studies` are left out by tests/run.sh and run by its --full.
include(${CMAKE_CURRENT_LIST_DIR}/MpiEnvironment.cmake)

# slipscale_test(<name> SOURCES a.cpp … RANKS 1 2 3 [NIGHTLY 1 3] LABELS unit [TIMEOUT seconds])
#
# A GoogleTest executable that ctest runs once for each stated number of MPI ranks; those behind NIGHTLY repeat what the
# others showed. The shared main() starts MPI and PETSc, prints on rank 0 and fails when any rank fails.
function(slipscale_test name)
  cmake_parse_arguments(arg "" "TIMEOUT" "SOURCES;RANKS;NIGHTLY;LABELS" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 300)
  endif()
  add_executable(${name} ${arg_SOURCES})
  list(TRANSFORM arg_SOURCES PREPEND ${CMAKE_CURRENT_SOURCE_DIR}/)
  set_property(GLOBAL APPEND PROPERTY slipscale_test_files ${arg_SOURCES})
  target_link_libraries(${name} PRIVATE slipscale_test_support)
  foreach(ranks IN LISTS arg_RANKS arg_NIGHTLY)
    set(labels ${arg_LABELS})
    if(ranks IN_LIST arg_NIGHTLY)
      list(APPEND labels nightly)
    endif()
    add_test(NAME ${name}.np${ranks}
             COMMAND ${MPIEXEC_EXECUTABLE} -n ${ranks} $<TARGET_FILE:${name}>)
    set_tests_properties(${name}.np${ranks} PROPERTIES
      LABELS "${labels}" PROCESSORS ${ranks} TIMEOUT ${arg_TIMEOUT}
      ENVIRONMENT "${SLIPSCALE_MPI_ENVIRONMENT}")
  endforeach()
endfunction()

# slipscale_python_test(<name> FILE test.py [CASES Case Case.test_one …] LABELS programs [PROCESSORS 2]
#                       [TIMEOUT seconds] [ENVIRONMENT A=b …])
#
# The unittest cases of a file, or those named; no case at all is a failure.
function(slipscale_python_test name)
  cmake_parse_arguments(arg "" "FILE;PROCESSORS;TIMEOUT" "CASES;LABELS;ENVIRONMENT" ${ARGN})
  if(NOT arg_TIMEOUT)
    set(arg_TIMEOUT 600)
  endif()
  if(NOT arg_PROCESSORS)
    set(arg_PROCESSORS 1)
  endif()
  add_test(NAME ${name} COMMAND ${SLIPSCALE_PYTHON} -B ${PROJECT_SOURCE_DIR}/tests/support/run_python.py
                                ${CMAKE_CURRENT_SOURCE_DIR}/${arg_FILE} ${arg_CASES})
  set_property(GLOBAL APPEND PROPERTY slipscale_test_files ${CMAKE_CURRENT_SOURCE_DIR}/${arg_FILE})
  set_tests_properties(${name} PROPERTIES
    LABELS "${arg_LABELS}" PROCESSORS ${arg_PROCESSORS} TIMEOUT ${arg_TIMEOUT}
    ENVIRONMENT "${SLIPSCALE_MPI_ENVIRONMENT};${arg_ENVIRONMENT}")
endfunction()

# A file of tests that no test runs would pass for ever: refused.
function(slipscale_all_files_are_run)
  file(GLOB files CONFIGURE_DEPENDS ${CMAKE_CURRENT_SOURCE_DIR}/test_*.py ${CMAKE_CURRENT_SOURCE_DIR}/*/test_*.py
       ${CMAKE_CURRENT_SOURCE_DIR}/*/*.cpp)
  get_property(run GLOBAL PROPERTY slipscale_test_files)
  list(REMOVE_ITEM files ${run})
  foreach(file ${files})
    file(STRINGS ${file} cases REGEX "^(TEST|TEST_F|TEST_P|class .*TestCase)" LIMIT_COUNT 1)
    if(cases OR file MATCHES "\\.py$")
      message(SEND_ERROR "${file} holds tests, but no slipscale_test or slipscale_python_test names it")
    endif()
  endforeach()
endfunction()
