# Writes two headers, untouched if they are the same. FOLDER/framework/output/build_info.hpp: the commit of the checkout ("" outside of git), whether tracked sources
# differ from it, and how many source files it does not have (which are compiled all the same, also those that git ignores).
# FOLDER/framework/plugin/headers_digest.hpp: which headers plugins have to be built against.
#   cmake -DSOURCE=DIR -DFOLDER=DIR -DPROJECT_VERSION=... -DCOMPILER=... -DFLAGS=... -P write_build_info.cmake
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
configure_file(${CMAKE_CURRENT_LIST_DIR}/build_info.hpp.in ${FOLDER}/framework/output/build_info.hpp @ONLY)

# Those that are installed.
file(GLOB_RECURSE HEADERS RELATIVE ${SOURCE} ${SOURCE}/geometry/*.hpp ${SOURCE}/framework/*.hpp ${SOURCE}/energies/*.hpp
     ${SOURCE}/solvers/*.hpp)
list(FILTER HEADERS EXCLUDE REGEX "^framework/app/")
set(ALL "")
foreach(HEADER ${HEADERS})
  file(SHA256 ${SOURCE}/${HEADER} DIGEST)
  string(APPEND ALL "${HEADER} ${DIGEST}\n")
endforeach()
string(SHA256 DIGEST "${ALL}")
string(SUBSTRING ${DIGEST} 0 16 DIGEST)
configure_file(${CMAKE_CURRENT_LIST_DIR}/headers_digest.hpp.in ${FOLDER}/framework/plugin/headers_digest.hpp @ONLY)
