# Tells the test runner every test case of the test program, one entry each, whatever characters its name
# has (`;` would split it in a list of CMake). Run after each build of the program:
#   cmake -D PROGRAM=... -D OUTPUT=... -D TIMEOUT=... -D NIGHTLY_TIMEOUT=... -D ENVIRONMENT=... -P discover_tests.cmake
# An entry whose name matches nothing fails (--warn NoTests) instead of passing with no test run. Those with the tag [nightly]
# have that label, NIGHTLY_TIMEOUT, and "case", as labels are otherwise what programs of their own have.
cmake_policy(VERSION 3.25)
execute_process(COMMAND ${PROGRAM} --list-test-names-only OUTPUT_VARIABLE NAMES RESULT_VARIABLE RESULT)
if(NOT RESULT MATCHES "^[1-9]")  # the number of test cases, as far as an exit code holds it
  message(FATAL_ERROR "${PROGRAM} --list-test-names-only: ${RESULT}\n${NAMES}")
endif()
execute_process(COMMAND ${PROGRAM} --list-test-names-only [nightly] OUTPUT_VARIABLE NIGHTLY)

string(ASCII 1 SEMICOLON)
string(ASCII 2 OPEN)
string(ASCII 3 CLOSE)
foreach(LIST NAMES NIGHTLY)
  string(REPLACE ";" "${SEMICOLON}" ${LIST} "${${LIST}}")
  string(REPLACE "[" "${OPEN}" ${LIST} "${${LIST}}")  # brackets keep a list from being split
  string(REPLACE "]" "${CLOSE}" ${LIST} "${${LIST}}")
  string(REPLACE "\n" ";" ${LIST} "${${LIST}}")
endforeach()
set(SCRIPT "")
foreach(NAME IN LISTS NAMES)
  if(NAME STREQUAL "")
    continue()
  endif()
  set(LABELS "")
  set(SECONDS ${TIMEOUT})
  list(FIND NIGHTLY "${NAME}" IN_NIGHTLY)
  if(NOT IN_NIGHTLY EQUAL -1)
    set(LABELS "LABELS [==[nightly;case]==]")
    set(SECONDS ${NIGHTLY_TIMEOUT})
  endif()
  string(REPLACE "${SEMICOLON}" ";" NAME "${NAME}")
  string(REPLACE "${OPEN}" "[" NAME "${NAME}")
  string(REPLACE "${CLOSE}" "]" NAME "${NAME}")
  set(SPEC "${NAME}")
  foreach(SPECIAL "\\" "," "[" "]")
    string(REPLACE "${SPECIAL}" "\\${SPECIAL}" SPEC "${SPEC}")
  endforeach()
  string(APPEND SCRIPT "add_test([==[${NAME}]==] [==[${PROGRAM}]==] [==[${SPEC}]==] --warn NoTests)\n"
         "set_tests_properties([==[${NAME}]==] PROPERTIES TIMEOUT ${SECONDS} ENVIRONMENT [==[${ENVIRONMENT}]==] ${LABELS})\n")
endforeach()
file(WRITE ${OUTPUT} "${SCRIPT}")
