# The Python that plots, sweeps and tests: SLIPSCALE_PYTHON, the first python3 that has what these need. Another one than
# the system's often stands first in the path and lacks numpy or h5py. One's own: cmake -D SLIPSCALE_PYTHON=/path/python3.
set(slipscale_python_modules "numpy, h5py, matplotlib, yaml")

function(slipscale_python_serves result candidate)
  execute_process(COMMAND ${candidate} -c "import sys, ${slipscale_python_modules}; sys.exit(sys.version_info < (3, 11))"
                  RESULT_VARIABLE code OUTPUT_QUIET ERROR_QUIET)
  if(NOT code EQUAL 0)
    set(${result} FALSE PARENT_SCOPE)
  endif()
endfunction()

find_program(SLIPSCALE_PYTHON NAMES python3 python PATHS /usr/bin VALIDATOR slipscale_python_serves
             DOC "Python 3.11 or newer with numpy, h5py, matplotlib and yaml")

include(FindPackageHandleStandardArgs)
string(CONCAT slipscale_python_advice
  "no python3 of version 3.11 or newer in the path imports ${slipscale_python_modules}: install them "
  "(cmake/install-dependencies.sh) or give -D SLIPSCALE_PYTHON=/path/to/python3")
find_package_handle_standard_args(SlipscalePython REQUIRED_VARS SLIPSCALE_PYTHON
  REASON_FAILURE_MESSAGE "${slipscale_python_advice}")
mark_as_advanced(SLIPSCALE_PYTHON)
