# The Python of the command `slipscale`: the first that has what the package needs, Debian's own before others.
#   SLIPSCALE_PYTHON   its path; give it (-D SLIPSCALE_PYTHON=…) where none of the usual ones has them
set(slipscale_python_modules numpy h5py matplotlib yaml)

function(slipscale_python_has_all result python)
  list(JOIN slipscale_python_modules ", " modules)
  execute_process(COMMAND ${python} -c "import ${modules}" RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
  if(code EQUAL 0)
    set(${result} TRUE PARENT_SCOPE)
  else()
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

if(NOT SLIPSCALE_PYTHON)
  find_program(slipscale_debian_python python3 PATHS /usr/bin NO_DEFAULT_PATH NO_CACHE)
  find_program(slipscale_first_python NAMES python3 python NO_CACHE)
  set(found "")
  foreach(python ${slipscale_debian_python} ${slipscale_first_python})
    slipscale_python_has_all(complete ${python})
    if(complete)
      set(found ${python})
      break()
    endif()
  endforeach()
  if(NOT found)
    list(JOIN slipscale_python_modules ", " modules)
    message(FATAL_ERROR "No python3 has ${modules}: cmake/install-dependencies.sh installs them on Debian; elsewhere "
      "install them, or give the path of a Python that has them: -D SLIPSCALE_PYTHON=…")
  endif()
  set(SLIPSCALE_PYTHON ${found} CACHE FILEPATH "Python with ${slipscale_python_modules}")
endif()

# The launcher of the build tree lies beside the programs and uses the package of the source tree; that which is
# installed finds the package from where it lies itself.
set(slipscale_runs "Path(\"${PROJECT_SOURCE_DIR}/runs\")")
configure_file(${PROJECT_SOURCE_DIR}/cmake/slipscale.in ${PROJECT_BINARY_DIR}/slipscale @ONLY
  FILE_PERMISSIONS OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(slipscale_shared ${CMAKE_INSTALL_DATADIR}/slipscale/runs)
file(RELATIVE_PATH slipscale_up /${CMAKE_INSTALL_BINDIR} /${slipscale_shared})
set(slipscale_runs "HERE / \"${slipscale_up}\"")
configure_file(${PROJECT_SOURCE_DIR}/cmake/slipscale.in ${PROJECT_BINARY_DIR}/installed/slipscale @ONLY)
install(PROGRAMS ${PROJECT_BINARY_DIR}/installed/slipscale DESTINATION ${CMAKE_INSTALL_BINDIR} COMPONENT slipscale)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/meshes DESTINATION ${CMAKE_INSTALL_DATADIR}/slipscale COMPONENT slipscale)
install(DIRECTORY ${PROJECT_SOURCE_DIR}/runs/ DESTINATION ${slipscale_shared} USE_SOURCE_PERMISSIONS
  COMPONENT slipscale
  PATTERN __pycache__ EXCLUDE
  PATTERN .snakemake EXCLUDE
  REGEX "/runs/tests$" EXCLUDE)
