# Compiler options of all targets (the target tack_options), and the precompiled headers.
include_guard()

add_library(tack_options INTERFACE)
target_include_directories(tack_options INTERFACE ${CMAKE_SOURCE_DIR})

# Eigen's arrays have the alignment of the widest instruction set, whichever the build has: see geometry/types.hpp.
set(TACK_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64)
target_compile_definitions(tack_options INTERFACE ${TACK_ALIGNMENT})
if(NOT TACK_CHECK_FORMATS)
  target_compile_definitions(tack_options INTERFACE FMT_CONSTEVAL=)
endif()

# Options that change what is computed; results name them (framework/output/provenance.hpp).
set(TACK_CODE_OPTIONS -fno-math-errno)
if(TACK_ARCHITECTURE)
  list(PREPEND TACK_CODE_OPTIONS -march=${TACK_ARCHITECTURE})
elseif(TACK_NATIVE)
  list(PREPEND TACK_CODE_OPTIONS -march=native)
endif()

# The optimisation of cold folders (tack_folders.cmake).
set(TACK_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)

if(CMAKE_CXX_COMPILER_ID STREQUAL "GNU")
  set(TACK_COMPILER_OPTIONS
      # GCC spends a tenth of its time on collecting its garbage.
      --param=ggc-min-heapsize=600000
      # GCC 12 raises false alarms inside its own intrinsics and Eigen.
      -Wno-maybe-uninitialized -Wno-uninitialized -Wno-restrict -Wno-stringop-overflow -Wno-use-after-free -Wno-array-bounds)
  # Without it, -O1 leaves the upper halves of vector registers in use, which slows down functions of libm that are not compiled for AVX.
  set(TACK_CLEAN_REGISTERS $<$<CONFIG:Release>:-fexpensive-optimizations>)
  # False alarm where files are compiled together: their unnamed namespaces look like those of a header.
  set(TACK_UNITY_OPTIONS -Wno-subobject-linkage)
else()
  # Clang also reports names that shadow those of another file's unnamed namespace, where files are compiled together; GCC finds all others.
  set(TACK_COMPILER_OPTIONS -Wno-shadow)
  set(TACK_CLEAN_REGISTERS "")
  set(TACK_UNITY_OPTIONS "")
endif()
target_compile_options(tack_options INTERFACE -Wall -Wextra -Wshadow -Wpedantic ${TACK_CODE_OPTIONS}
                       -fno-semantic-interposition  # libraries inline as programs do
                       ${TACK_COMPILER_OPTIONS})

if(TACK_SANITIZE)
  # Null and misaligned pointers are left to the address sanitizer and to Eigen's assertions: these two checks take ten times as long to compile in Eigen's
  # expressions as all others together.
  target_compile_options(tack_options INTERFACE -fsanitize=address,undefined -fno-sanitize=null,alignment -fno-omit-frame-pointer -O1)
  target_compile_definitions(tack_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(tack_options INTERFACE -fsanitize=address,undefined)
endif()

if(TACK_COVERAGE)
  target_compile_options(tack_options INTERFACE --coverage -fprofile-update=atomic -O1)
  target_link_options(tack_options INTERFACE --coverage)
  # After the tests: a report of the lines and branches that they ran, build/coverage/report/index.html.
  add_custom_target(tack_coverage VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${CMAKE_BINARY_DIR}/report
    COMMAND gcovr --root ${CMAKE_SOURCE_DIR} --object-directory ${CMAKE_BINARY_DIR} --filter ${CMAKE_SOURCE_DIR}/geometry/ --filter ${CMAKE_SOURCE_DIR}/framework/
            --filter ${CMAKE_SOURCE_DIR}/energies/ --filter ${CMAKE_SOURCE_DIR}/solvers/ --gcov-ignore-parse-errors
            --print-summary --html-details ${CMAKE_BINARY_DIR}/report/index.html ${CMAKE_BINARY_DIR}
    COMMENT "Counting the lines that tests have run")
endif()

# Precompiled headers, one for hot and one for cold folders: GCC compiles a file with the optimisation of the precompiled header that it includes.
set(TACK_PRECOMPILED <Eigen/Core> <Eigen/LU> <fmt/format.h> <tbb/parallel_for.h> <algorithm> <array> <cmath>
    <functional> <map> <memory> <optional> <string> <vector>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
foreach(TARGET tack_precompiled tack_precompiled_cold)
  add_library(${TARGET} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_precompile_headers(${TARGET} PRIVATE ${TACK_PRECOMPILED})
  target_link_libraries(${TARGET} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
endforeach()
target_compile_options(tack_precompiled_cold PRIVATE ${TACK_COLD_OPTIONS} ${TACK_CLEAN_REGISTERS})

# tack_precompile_cold(TARGET): compiles TARGET with the precompiled header of cold folders.
function(tack_precompile_cold TARGET)
  target_precompile_headers(${TARGET} REUSE_FROM tack_precompiled_cold)
  target_compile_options(${TARGET} PRIVATE ${TACK_CLEAN_REGISTERS} -fPIC)  # as the header was: programs would have -fPIE
endfunction()
