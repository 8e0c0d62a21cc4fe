# Writes build_info.hpp, untouched if it is the same: the commit of the checkout ("" outside of git), whether tracked sources
# differ from it, and how many source files it does not have (which are compiled all the same, also those that git ignores).
#   cmake -DSOURCE=DIR -DOUTPUT=FILE -DPROJECT_VERSION=... -DCOMPILER=... -DFLAGS=... -P write_build_info.cmake
set(COMMIT "")
set(CHANGED 0)
set(UNTRACKED 0)
set(FOLDERS geometry framework energies solvers cmake)
# A release that was unpacked inside another project's checkout has no commit.
execute_process(COMMAND git -C ${SOURCE} rev-parse --show-prefix --short=12 HEAD
                OUTPUT_VARIABLE ANSWER RESULT_VARIABLE STATUS ERROR_QUIET)
if(STATUS EQUAL 0 AND ANSWER MATCHES "^\n([0-9a-f]+)\n$")
  set(COMMIT ${CMAKE_MATCH_1})
  execute_process(COMMAND git -C ${SOURCE} diff --quiet HEAD -- ${FOLDERS} CMakeLists.txt CMakePresets.json
                  RESULT_VARIABLE STATUS OUTPUT_QUIET ERROR_QUIET)
  if(NOT STATUS EQUAL 0)
    set(CHANGED 1)
  endif()
  execute_process(COMMAND git -C ${SOURCE} ls-files --others -- ${FOLDERS} OUTPUT_VARIABLE FILES ERROR_QUIET)
  string(REGEX MATCHALL "\\.(cpp|hpp|cmake|in)\"?\n" FILES "${FILES}")
  list(LENGTH FILES UNTRACKED)
endif()
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_info.hpp.in ${OUTPUT} @ONLY)
