# Writes FILE with the commit of the sources in SOURCE: at build time, so that it is that of what is built.
# Sources that are no git clone of their own (a tarball, a folder in another clone) have none.
set(commit "")
if(GIT AND EXISTS ${SOURCE}/.git)
  execute_process(COMMAND ${GIT} -C ${SOURCE} describe --always --exclude=* --abbrev=12 --dirty
                  OUTPUT_VARIABLE commit OUTPUT_STRIP_TRAILING_WHITESPACE ERROR_QUIET RESULT_VARIABLE fault)
  if(NOT fault EQUAL 0)
    set(commit "")
  endif()
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/commit.hpp.in ${FILE} @ONLY)
