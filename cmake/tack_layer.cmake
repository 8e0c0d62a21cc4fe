# One OBJECT library per layer: components register themselves from static initialisers, which a
# static archive would drop. Sources are globbed, so a new file in the right folder is enough.
add_library(tack_options INTERFACE)
target_include_directories(tack_options INTERFACE ${CMAKE_SOURCE_DIR})
target_compile_options(tack_options INTERFACE -Wall -Wextra -Wshadow -Wpedantic
                       $<$<CONFIG:Release>:-O3> $<$<BOOL:${TACK_NATIVE}>:-march=native>
                       -fno-math-errno
                       # false alarms of GCC 12 inside its own intrinsics and Eigen
                       -Wno-maybe-uninitialized -Wno-uninitialized -Wno-restrict
                       -Wno-stringop-overflow -Wno-use-after-free -Wno-array-bounds)
if(TACK_SANITIZE)
  target_compile_options(tack_options INTERFACE -fsanitize=address,undefined
                         -fno-omit-frame-pointer -g -O1)
  target_link_options(tack_options INTERFACE -fsanitize=address,undefined)
endif()

# What nearly every file includes, parsed once per target.
set(TACK_PRECOMPILED <Eigen/Core> <Eigen/LU> <fmt/format.h> <tbb/parallel_for.h> <algorithm> <array> <cmath>
    <functional> <map> <memory> <optional> <string> <vector>)

# Parsing, describing and writing are not worth the optimiser's time.
set(TACK_COLD_FOLDERS framework/config framework/scene framework/output framework/probes framework/app
    geometry/io geometry/mesh geometry/shapes)
function(tack_cool SOURCES)
  foreach(FOLDER ${TACK_COLD_FOLDERS})
    set(COLD ${SOURCES})
    list(FILTER COLD INCLUDE REGEX "/${FOLDER}/")
    set_source_files_properties(${COLD} PROPERTIES COMPILE_OPTIONS $<$<CONFIG:Release>:-O1>)
  endforeach()
endfunction()

function(tack_layer NAME)
  cmake_parse_arguments(L "" "" "EXCLUDE;LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB_RECURSE SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${NAME}/*.cpp)
  foreach(FOLDER ${L_EXCLUDE})
    list(FILTER SOURCES EXCLUDE REGEX "/${NAME}/${FOLDER}/")
  endforeach()
  tack_cool("${SOURCES}")
  add_library(tack_${NAME} OBJECT ${SOURCES})
  target_precompile_headers(tack_${NAME} PRIVATE ${TACK_PRECOMPILED})
  target_link_libraries(tack_${NAME} PUBLIC tack_options ${L_LINKS} PRIVATE ${L_PRIVATE_LINKS})
  set_property(GLOBAL APPEND PROPERTY TACK_LAYERS tack_${NAME})
  set_property(GLOBAL APPEND PROPERTY TACK_LINKS ${L_PRIVATE_LINKS})
endfunction()

# Everything an executable needs: the layers' objects and the libraries they use.
function(tack_link_all TARGET)
  get_property(LAYERS GLOBAL PROPERTY TACK_LAYERS)
  get_property(LINKS GLOBAL PROPERTY TACK_LINKS)
  foreach(LAYER ${LAYERS})
    target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:${LAYER}>)
  endforeach()
  target_link_libraries(${TARGET} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt
                        nlohmann_json::nlohmann_json CLI11::CLI11 Threads::Threads ${LINKS})
endfunction()

function(tack_app)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/app/*.cpp)
  tack_cool("${SOURCES}")
  add_executable(tack_cli ${SOURCES})
  target_precompile_headers(tack_cli PRIVATE ${TACK_PRECOMPILED} <CLI/CLI.hpp>)
  set_target_properties(tack_cli PROPERTIES OUTPUT_NAME tack RUNTIME_OUTPUT_DIRECTORY
                        ${CMAKE_BINARY_DIR}/bin)
  # The commit goes into every summary.json; it is read again at each build.
  add_custom_target(tack_version
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DPROJECT_VERSION=${PROJECT_VERSION}
            -DOUTPUT=${CMAKE_BINARY_DIR}/generated/framework/app/version.hpp
            -P ${CMAKE_SOURCE_DIR}/cmake/write_version.cmake
    BYPRODUCTS ${CMAKE_BINARY_DIR}/generated/framework/app/version.hpp)
  add_dependencies(tack_cli tack_version)
  target_include_directories(tack_cli PRIVATE ${CMAKE_BINARY_DIR}/generated)
  tack_link_all(tack_cli)
endfunction()
