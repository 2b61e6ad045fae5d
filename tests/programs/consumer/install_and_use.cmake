# cmake -D BUILD=<build tree> -D SCRATCH=<folder> -D GENERATOR=… -D COMPILER=… -D VERSION=… -P install_and_use.cmake
# Installs slipscale into a scratch folder, asks every program there for its version, builds programs of another project on
# both libraries and runs them; then installs without the component that links gmsh and sees that nothing of it is there.
function(run)
  execute_process(COMMAND ${ARGN} OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "${ARGN}\n${said}")
  endif()
  set(said "${said}" PARENT_SCOPE)
endfunction()

file(REMOVE_RECURSE ${SCRATCH})
run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/all)
foreach(program slide homogenize relocalize morphology)
  run(${SCRATCH}/all/bin/${program} -version)
  message("${said}")
  if(NOT said MATCHES "^${program} ${VERSION}")
    message(FATAL_ERROR "${program} -version does not say ${VERSION}:\n${said}")
  endif()
endforeach()

# The command finds its package and the programs beside it, wherever it is called.
file(MAKE_DIRECTORY "${SCRATCH}/some where")
file(WRITE "${SCRATCH}/some where/scene.yaml" "friction: {coefficient: 0.3}\n")
foreach(words "-h" "--version" "sweep|scene.yaml|-material_all_young|30e9,40e9|--dry-run")
  string(REPLACE "|" ";" words "${words}")
  execute_process(COMMAND ${SCRATCH}/all/bin/slipscale ${words} WORKING_DIRECTORY "${SCRATCH}/some where"
    OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
  message("${said}")
  if(NOT code EQUAL 0)
    message(FATAL_ERROR "slipscale ${words} ends with ${code}:\n${said}")
  endif()
endforeach()
if(NOT said MATCHES "^2 runs")
  message(FATAL_ERROR "the sweep that is planned has not two runs:\n${said}")
endif()

run(${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${SCRATCH}/build -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${SCRATCH}/all)
run(${CMAKE_COMMAND} --build ${SCRATCH}/build)
foreach(program consumer draws)
  run(${SCRATCH}/build/${program})
  message("${said}")
endforeach()

run(${CMAKE_COMMAND} --install ${BUILD} --prefix ${SCRATCH}/permissive --component slipscale)
file(GLOB_RECURSE installed RELATIVE ${SCRATCH}/permissive ${SCRATCH}/permissive/*)
foreach(file ${installed})
  if(file MATCHES "^(bin|lib|include)/.*([Mm]orphology|[Gg]msh)")
    message(FATAL_ERROR "the component slipscale installs ${file}, which belongs to morphology")
  endif()
endforeach()
execute_process(COMMAND ${CMAKE_COMMAND} -S ${CMAKE_CURRENT_LIST_DIR} -B ${SCRATCH}/refused -G ${GENERATOR}
  -D CMAKE_CXX_COMPILER=${COMPILER} -D CMAKE_PREFIX_PATH=${SCRATCH}/permissive
  OUTPUT_VARIABLE said ERROR_VARIABLE said RESULT_VARIABLE code)
if(code EQUAL 0 OR NOT said MATCHES "without its component[ \n]+morphology")
  message(FATAL_ERROR "COMPONENTS morphology is not refused where it is not installed:\n${said}")
endif()
file(REMOVE_RECURSE ${SCRATCH})
