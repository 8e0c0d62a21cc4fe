# Fails unless the test runner knows exactly the test cases that the test program has, by count:
#   cmake -D PROGRAM=... -D BUILD=... -D CTEST=... -P count_tests.cmake
# The program counts them itself (its last line), so this shares nothing with discover_tests.cmake. The entries
# of the runner that are no test case begin with "tack_tests: ", or have a label (programs of their own), but not "case".
execute_process(COMMAND ${PROGRAM} --list-tests OUTPUT_VARIABLE CASES)
execute_process(COMMAND ${CTEST} --test-dir ${BUILD} -N OUTPUT_VARIABLE ENTRIES)
execute_process(COMMAND ${CTEST} --test-dir ${BUILD} -N -R "^tack_tests: " OUTPUT_VARIABLE OTHERS)
if(NOT CASES MATCHES "\n([0-9]+) test cases\n")
  message(FATAL_ERROR "${PROGRAM} --list-tests does not tell a count")
endif()
set(IN_PROGRAM ${CMAKE_MATCH_1})
string(REGEX MATCH "Total Tests: ([0-9]+)" UNUSED "${ENTRIES}")
set(IN_RUNNER ${CMAKE_MATCH_1})
string(REGEX MATCH "Total Tests: ([0-9]+)" UNUSED "${OTHERS}")
math(EXPR IN_RUNNER "${IN_RUNNER} - ${CMAKE_MATCH_1}")
execute_process(COMMAND ${CTEST} --test-dir ${BUILD} -N -L "." -LE "^case$" OUTPUT_VARIABLE PROGRAMS)
string(REGEX MATCH "Total Tests: ([0-9]+)" UNUSED "${PROGRAMS}")
math(EXPR IN_RUNNER "${IN_RUNNER} - ${CMAKE_MATCH_1}")
if(NOT IN_RUNNER EQUAL IN_PROGRAM)
  message(FATAL_ERROR "the test runner knows ${IN_RUNNER} test cases, the test program has ${IN_PROGRAM}: names "
                      "that ${PROGRAM} --list-test-names-only and ctest -N do not share are lost or split; see "
                      "tests/discover_tests.cmake")
endif()
message("${IN_PROGRAM} test cases")
