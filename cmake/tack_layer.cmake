# One OBJECT library per layer: components register themselves from static initialisers, which a
# static archive would drop. Sources are globbed, so a new file in the right folder is enough.
add_library(tack_options INTERFACE)
target_include_directories(tack_options INTERFACE ${CMAKE_SOURCE_DIR})
# Eigen's arrays are aligned for the widest instruction set, whichever is compiled for: see geometry/types.hpp.
set(TACK_ALIGNMENT EIGEN_MAX_ALIGN_BYTES=64 EIGEN_MAX_STATIC_ALIGN_BYTES=64)
target_compile_definitions(tack_options INTERFACE ${TACK_ALIGNMENT})
if(NOT TACK_CHECK_FORMATS)
  target_compile_definitions(tack_options INTERFACE FMT_CONSTEVAL=)
endif()
set(TACK_CODE_OPTIONS -fno-math-errno)  # those that change what is computed; written into results
if(TACK_ARCHITECTURE)
  list(PREPEND TACK_CODE_OPTIONS -march=${TACK_ARCHITECTURE})
elseif(TACK_NATIVE)
  list(PREPEND TACK_CODE_OPTIONS -march=native)
endif()
target_compile_options(tack_options INTERFACE -Wall -Wextra -Wshadow -Wpedantic ${TACK_CODE_OPTIONS}
                       # what is compiled for libraries too is inlined as in a program
                       -fno-semantic-interposition
                       # a tenth of the compiler's time went into collecting its garbage
                       --param=ggc-min-heapsize=600000
                       # false alarms of GCC 12 inside its own intrinsics and Eigen
                       -Wno-maybe-uninitialized -Wno-uninitialized -Wno-restrict
                       -Wno-stringop-overflow -Wno-use-after-free -Wno-array-bounds)
if(TACK_SANITIZE)
  # Null and misaligned pointers are left to the address sanitizer and to Eigen's assertions: in Eigen's
  # expressions those two checks take ten times as long to compile as all others together.
  target_compile_options(tack_options INTERFACE -fsanitize=address,undefined -fno-sanitize=null,alignment
                         -fno-omit-frame-pointer -O1)
  target_compile_definitions(tack_options INTERFACE _GLIBCXX_ASSERTIONS)
  target_link_options(tack_options INTERFACE -fsanitize=address,undefined)
endif()

# What nearly every file includes, parsed once for all layers, and once more for cold folders: GCC takes the optimisation of a precompiled
# header for that of the file that includes it.
set(TACK_PRECOMPILED <Eigen/Core> <Eigen/LU> <fmt/format.h> <tbb/parallel_for.h> <algorithm> <array> <cmath>
    <functional> <map> <memory> <optional> <string> <vector>)
file(CONFIGURE OUTPUT ${CMAKE_BINARY_DIR}/precompiled.cpp CONTENT "")
set(TACK_COLD_OPTIONS $<$<CONFIG:Release>:-O1>)
# Without it GCC leaves the upper halves of vector registers in use, which makes what of libm is not compiled for AVX slow.
set(TACK_CLEAN_REGISTERS $<$<CONFIG:Release>:-fexpensive-optimizations>)
foreach(TARGET tack_precompiled tack_precompiled_cold)
  add_library(${TARGET} OBJECT ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_precompile_headers(${TARGET} PRIVATE ${TACK_PRECOMPILED})
  target_link_libraries(${TARGET} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
endforeach()
target_compile_options(tack_precompiled_cold PRIVATE ${TACK_COLD_OPTIONS} ${TACK_CLEAN_REGISTERS})
function(tack_precompile_cold TARGET)
  target_precompile_headers(${TARGET} REUSE_FROM tack_precompiled_cold)
  target_compile_options(${TARGET} PRIVATE ${TACK_CLEAN_REGISTERS} -fPIC)  # as the header was: programs would have -fPIE
endfunction()

# Parsing, describing and writing are not worth the optimiser's time, nor the compiler's: the files of such
# a folder are compiled together, as what they instantiate is mostly the same. Of inline functions that are not inlined the linker keeps the
# first copy for all: hot objects are linked before cold ones.
option(TACK_UNITY "Compile each folder that is not hot at once: a clean build is shorter, a single change takes longer" ON)
# Commands that start from runs, or from laws: a program of their own, tack_studies, has them, so that a first run need not wait for them.
set(TACK_STUDY_FOLDERS framework/batch framework/calibrate framework/compare framework/law framework/plot framework/report framework/view)
set(TACK_STUDY_COMMANDS batch calibrate compare describe law plot render report view)
set(TACK_COLD_FOLDERS framework/config framework/plugin framework/measured framework/shapes framework/level_set framework/meshing framework/body framework/motion framework/world framework/scene
    framework/setup framework/checks framework/remesh framework/output
    framework/experiment framework/probes framework/profile framework/sensitivity framework/run framework/app ${TACK_STUDY_FOLDERS}
    geometry/io geometry/mesh geometry/meshing geometry/shapes)
# Hot ones whose files have most of their headers in common, a few at a time, as a change should not take longer than it must. Neither contact nor
# solids are among them, as what they inline into each other then makes runs 2 to 4% slower, nor distances, whose rounding at small gaps depends on it.
set(TACK_UNITED_FOLDERS geometry/broad_phase geometry/exact framework/assembly framework/bond framework/core framework/stepping
    energies/adhesion solvers/filters solvers/lcp solvers/linear solvers/minimizers)
# Where one file alone is enough, as CGAL or what it instantiates takes so long, what is hot beside cold ones, and what changes with every commit.
set(TACK_ALONE geometry/meshing/booleans.cpp geometry/meshing/repair.cpp geometry/meshing/tetrahedralize.cpp
    geometry/meshing/triangulate.cpp geometry/meshing/distance_grid.cpp framework/assembly/psd_projection.cpp framework/output/provenance.cpp framework/view/http_server.cpp)
# Folders of which each sees what the one before it sees too: compiled as one.
set(TACK_AS_ONE "body|motion|world=scene" "checks=setup")
# Components that most first scenes do without: a library that the program loads when one is named has them (framework/plugin/further_components.cpp), so
# that a first run need not wait for them. All of these folders but what first scenes name.
set(TACK_FURTHER_FOLDERS energies/interactions energies/loads energies/particle energies/plasticity energies/rod energies/shell solvers/lcp)
set(TACK_NAMED_FIRST energies/loads/loads.cpp energies/loads/pressure.cpp)
# tack_parts(AT_ONCE SOURCE...): sets PARTS to names of groups of them, each of one folder and at most so many, and IN_<name> to what is in one.
function(tack_parts AT_ONCE)
  set(FOLDERS "")
  foreach(SOURCE ${ARGN})
    cmake_path(GET SOURCE PARENT_PATH FOLDER)
    cmake_path(RELATIVE_PATH FOLDER BASE_DIRECTORY ${CMAKE_SOURCE_DIR})
    foreach(ONE ${TACK_AS_ONE})
      string(REGEX REPLACE "(.*)=.*" "\\1" FROM ${ONE})
      string(REGEX REPLACE ".*=" "" INTO ${ONE})
      string(REGEX REPLACE "framework/(${FROM})$" "framework/${INTO}" FOLDER ${FOLDER})
    endforeach()
    string(REPLACE "/" "_" FOLDER ${FOLDER})
    list(APPEND FOLDERS ${FOLDER})
    list(APPEND IN_${FOLDER} ${SOURCE})
  endforeach()
  list(REMOVE_DUPLICATES FOLDERS)
  set(ALL "")
  foreach(FOLDER ${FOLDERS})
    list(LENGTH IN_${FOLDER} COUNT)
    math(EXPR LAST "(${COUNT} - 1) / ${AT_ONCE}")
    foreach(PART RANGE ${LAST})
      math(EXPR FIRST "${PART} * ${COUNT} / (${LAST} + 1)")
      math(EXPR LENGTH "(${PART} + 1) * ${COUNT} / (${LAST} + 1) - ${FIRST}")
      list(SUBLIST IN_${FOLDER} ${FIRST} ${LENGTH} SOURCES)
      set(NAME ${FOLDER})
      if(LAST)
        string(APPEND NAME _${PART})
      endif()
      list(APPEND ALL ${NAME})
      set(IN_${NAME} ${SOURCES} PARENT_SCOPE)
    endforeach()
  endforeach()
  set(PARTS ${ALL} PARENT_SCOPE)
endfunction()

# tack_unite(TARGET AT_ONCE [FOLDER ...]): those of its sources that lie there, or all, are compiled folder by folder, at most so many at once.
function(tack_unite TARGET AT_ONCE)
  set_target_properties(${TARGET} PROPERTIES UNITY_BUILD ${TACK_UNITY} UNITY_BUILD_MODE GROUP)
  get_target_property(SOURCES ${TARGET} SOURCES)
  if(ARGN)
    list(JOIN ARGN "|" FOLDERS)
    list(FILTER SOURCES INCLUDE REGEX "/(${FOLDERS})/[^/]+$")
  endif()
  list(TRANSFORM TACK_ALONE PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE ALONE)
  list(REMOVE_ITEM SOURCES ${ALONE})
  tack_parts(${AT_ONCE} ${SOURCES})
  foreach(PART ${PARTS})
    set_source_files_properties(${IN_${PART}} PROPERTIES UNITY_GROUP ${PART})
  endforeach()
endfunction()
function(tack_cool TARGET)
  tack_unite(${TARGET} 100)
  target_compile_options(${TARGET} PRIVATE ${TACK_COLD_OPTIONS})
endfunction()

# tack_layer(NAME [EXCLUDE FOLDER] [LINKS ...] [PRIVATE_LINKS ...]): the sources below NAME/.
function(tack_layer NAME)
  cmake_parse_arguments(L "" "" "EXCLUDE;LINKS;PRIVATE_LINKS" ${ARGN})
  file(GLOB_RECURSE HOT CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${NAME}/*.cpp)
  foreach(FOLDER ${L_EXCLUDE})
    list(FILTER HOT EXCLUDE REGEX "/${NAME}/${FOLDER}/")
  endforeach()
  set(COLD ${HOT})
  list(JOIN TACK_COLD_FOLDERS "/|/" FOLDERS)
  list(FILTER HOT EXCLUDE REGEX "/${FOLDERS}/")
  list(FILTER COLD INCLUDE REGEX "/${FOLDERS}/")
  set(STUDIES ${COLD})
  list(JOIN TACK_STUDY_FOLDERS "/|/" FOLDERS)
  list(FILTER COLD EXCLUDE REGEX "/${FOLDERS}/")
  list(FILTER STUDIES INCLUDE REGEX "/${FOLDERS}/")
  set(FURTHER ${HOT})
  list(JOIN TACK_FURTHER_FOLDERS "/|/" FOLDERS)
  list(FILTER FURTHER INCLUDE REGEX "/${FOLDERS}/")
  list(TRANSFORM TACK_NAMED_FIRST PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE NAMED_FIRST)
  list(REMOVE_ITEM FURTHER ${NAMED_FIRST})
  list(REMOVE_ITEM HOT ${FURTHER})
  add_library(tack_${NAME} OBJECT ${HOT})
  tack_unite(tack_${NAME} 10 ${TACK_UNITED_FOLDERS})
  target_precompile_headers(tack_${NAME} REUSE_FROM tack_precompiled)
  set_property(GLOBAL APPEND PROPERTY TACK_HOT_LAYERS tack_${NAME})
  set(TARGETS tack_${NAME})
  if(FURTHER)
    add_library(tack_${NAME}_further OBJECT ${FURTHER})
    tack_unite(tack_${NAME}_further 10)
    target_compile_options(tack_${NAME}_further PRIVATE -Wno-subobject-linkage)  # of what is compiled with others, whose unnamed namespaces are no header's
    target_precompile_headers(tack_${NAME}_further REUSE_FROM tack_precompiled)
    set_property(GLOBAL APPEND PROPERTY TACK_FURTHER_LAYERS tack_${NAME}_further)
    list(APPEND TARGETS tack_${NAME}_further)
  endif()
  foreach(KIND COLD STUDIES)
    if(${KIND})
      string(TOLOWER tack_${NAME}_${KIND} TARGET)
      add_library(${TARGET} OBJECT ${${KIND}})
      tack_cool(${TARGET})
      tack_precompile_cold(${TARGET})
      set_property(GLOBAL APPEND PROPERTY TACK_${KIND}_LAYERS ${TARGET})
      list(APPEND TARGETS ${TARGET})
    endif()
  endforeach()
  foreach(TARGET ${TARGETS})
    target_link_libraries(${TARGET} PUBLIC tack_options ${L_LINKS} PRIVATE ${L_PRIVATE_LINKS})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TACK_LINKS ${L_PRIVATE_LINKS})
endfunction()

# tack_take_layers(TARGET KIND...): their objects, of which others may call what is tack's own.
function(tack_take_layers TARGET)
  set_target_properties(${TARGET} PROPERTIES LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/exports.map)
  target_link_options(${TARGET} PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/exports.map)
  foreach(KIND ${ARGN})
    get_property(LAYERS GLOBAL PROPERTY TACK_${KIND}_LAYERS)
    foreach(LAYER ${LAYERS})
      target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:${LAYER}>)
    endforeach()
  endforeach()
  target_link_libraries(${TARGET} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
endfunction()
# Everything an executable needs: the layers' objects, hot ones first, and the libraries they use. tack_link_all adds those of further components and of
# studies.
function(tack_link_layers TARGET)
  tack_take_layers(${TARGET} ${ARGN})
  get_property(LINKS GLOBAL PROPERTY TACK_LINKS)
  target_link_libraries(${TARGET} PRIVATE CLI11::CLI11 Threads::Threads ${LINKS})
endfunction()
function(tack_link TARGET)
  tack_link_layers(${TARGET} HOT COLD)
endfunction()
function(tack_link_all TARGET)
  tack_link_layers(${TARGET} HOT FURTHER COLD STUDIES)
endfunction()

# tack_own_library(NAME SOURCES... ): libtack_NAME.so, which the program opens when it needs it, beside the program. geometry/NAME/functions.hpp
# has the table of what is in it, geometry/NAME_library.cpp calls it; the program refuses a library that was built from other HEADERS,
# or in another way.
function(tack_own_library NAME)
  cmake_parse_arguments(L "" "" "SOURCES;HEADERS;LINKS" ${ARGN})
  add_library(tack_${NAME} MODULE ${L_SOURCES})
  tack_cool(tack_${NAME})
  # Hidden, as the program has functions of the same names.
  set_target_properties(tack_${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin CXX_VISIBILITY_PRESET hidden)
  target_link_libraries(tack_${NAME} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt ${L_LINKS})
  target_link_options(tack_${NAME} PRIVATE $<$<NOT:$<BOOL:${TACK_SANITIZE}>>:-Wl,--no-undefined>)
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${L_HEADERS})
  set(ALL "${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${TACK_NATIVE} ${TACK_SANITIZE}")
  foreach(HEADER ${L_HEADERS})
    file(SHA256 ${HEADER} DIGEST)
    string(APPEND ALL ${DIGEST})
  endforeach()
  string(SHA256 DIGEST "${ALL}")
  string(TOUPPER ${NAME} UPPER)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/geometry/${NAME}/functions.cpp ${CMAKE_SOURCE_DIR}/geometry/${NAME}_library.cpp
                              PROPERTIES COMPILE_DEFINITIONS TACK_${UPPER}_INTERFACE="${DIGEST}" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# CGAL's operations and OpenVDB's grids, with copies of its own of what they use of geometry/mesh.
function(tack_meshing_library)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/meshing/*.cpp)
  foreach(FILE cleanup mesh mesh_quality quality surface triangle_surface)
    list(APPEND SOURCES ${CMAKE_SOURCE_DIR}/geometry/mesh/${FILE}.cpp)
  endforeach()
  file(GLOB HEADERS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/meshing/*.hpp ${CMAKE_SOURCE_DIR}/geometry/*.hpp
       ${CMAKE_SOURCE_DIR}/geometry/mesh/mesh.hpp ${CMAKE_SOURCE_DIR}/geometry/mesh/flat_mesh.hpp ${CMAKE_SOURCE_DIR}/geometry/level_set/distance_grid.hpp)
  tack_own_library(meshing SOURCES ${SOURCES} HEADERS ${HEADERS} LINKS CGAL::CGAL ${OPENVDB_LIBRARY} ${IMATH_LIBRARY})
  set_source_files_properties(${CMAKE_SOURCE_DIR}/geometry/meshing/distance_grid.cpp PROPERTIES
                              COMPILE_OPTIONS $<$<CONFIG:Release>:-O3>)
endfunction()

# Mesh files by Gmsh, which takes the loader longer than all else together.
function(tack_msh_library)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/msh/*.cpp)
  file(GLOB HEADERS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/msh/*.hpp ${CMAKE_SOURCE_DIR}/geometry/types.hpp
       ${CMAKE_SOURCE_DIR}/geometry/errors.hpp ${CMAKE_SOURCE_DIR}/geometry/mesh/mesh.hpp)
  tack_own_library(msh SOURCES ${SOURCES} HEADERS ${HEADERS} LINKS ${TACK_GMSH})
endfunction()

# Further components, as a library that calls the program that loads it, like a plugin.
function(tack_further_library)
  add_library(tack_further MODULE ${CMAKE_SOURCE_DIR}/cmake/plugin_note.cpp)
  tack_take_layers(tack_further FURTHER)
  set_target_properties(tack_further PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  target_include_directories(tack_further PRIVATE ${CMAKE_BINARY_DIR}/generated)
  add_dependencies(tack_further tack_build_info)
endfunction()

# What it was built from goes into every summary.json; it is read again at each build.
function(tack_build_info)
  string(TOUPPER "${CMAKE_BUILD_TYPE}" TYPE)
  set(FLAGS "${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${CMAKE_CXX_FLAGS_${TYPE}} ${TACK_CODE_OPTIONS}")
  string(REGEX REPLACE "[ ;]+" " " FLAGS "${FLAGS}")
  set(FOLDER ${CMAKE_BINARY_DIR}/generated)
  add_custom_target(tack_build_info VERBATIM
    BYPRODUCTS ${FOLDER}/framework/output/build_info.hpp ${FOLDER}/framework/plugin/headers_digest.hpp
    COMMAND ${CMAKE_COMMAND} -DSOURCE=${CMAKE_SOURCE_DIR} -DFOLDER=${FOLDER} -DPROJECT_VERSION=${PROJECT_VERSION}
            "-DCOMPILER=${CMAKE_CXX_COMPILER_ID} ${CMAKE_CXX_COMPILER_VERSION}" "-DFLAGS=${FLAGS}"
            -P ${CMAKE_SOURCE_DIR}/cmake/write_build_info.cmake)
  add_dependencies(tack_framework_cold tack_build_info)
  target_include_directories(tack_framework_cold PRIVATE ${FOLDER})
endfunction()

# The page of `tack report`, and what `tack render` draws with, beside the program: made of report/ and of libraries that npm fetches. Not a part of `all`: everything else
# is built without npm and without a network. Both programs are looked for when it is made: `./tack` may have installed them after cmake ran.
function(tack_report_page)
  set(MODULES ${CMAKE_BINARY_DIR}/report)
  set(PAGE ${CMAKE_BINARY_DIR}/share/report.html)
  set(SOURCE ${CMAKE_SOURCE_DIR}/report)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${SOURCE}/src/*)
  add_custom_command(OUTPUT ${MODULES}/fetched VERBATIM DEPENDS ${SOURCE}/package.json ${SOURCE}/package-lock.json
    COMMAND ${CMAKE_COMMAND} -E make_directory ${MODULES}
    COMMAND ${CMAKE_COMMAND} -E copy ${SOURCE}/package.json ${SOURCE}/package-lock.json ${MODULES}
    COMMAND npm --prefix ${MODULES} ci --ignore-scripts --no-audit --no-fund
    COMMAND ${CMAKE_COMMAND} -E touch ${MODULES}/fetched
    COMMENT "Fetching the libraries of the page of reports")
  add_custom_command(OUTPUT ${PAGE} VERBATIM DEPENDS ${MODULES}/fetched ${SOURCE}/build.mjs ${SOURCE}/render.mjs ${SOURCES}
    COMMAND node ${SOURCE}/build.mjs ${MODULES} ${PAGE}
    COMMENT "Making the page of reports")
  add_custom_target(tack_report DEPENDS ${PAGE})
endfunction()

# Both programs, side by side: tack, which starts the other one for what it lacks, and tack_studies, which has all.
function(tack_app)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/app/*.cpp)
  list(JOIN TACK_STUDY_COMMANDS "|" COMMANDS)
  set(STUDIES ${SOURCES})
  list(FILTER STUDIES INCLUDE REGEX "/(${COMMANDS})_command.cpp$")
  set(ELSEWHERE ${CMAKE_SOURCE_DIR}/framework/app/in_studies.cpp)
  list(REMOVE_ITEM SOURCES ${STUDIES} ${ELSEWHERE})
  add_library(tack_app OBJECT ${SOURCES})
  add_executable(tack_cli ${ELSEWHERE})
  add_executable(tack_studies ${STUDIES})
  set_target_properties(tack_cli PROPERTIES OUTPUT_NAME tack)
  foreach(TARGET tack_app tack_cli tack_studies)
    tack_cool(${TARGET})
    tack_precompile_cold(${TARGET})
  endforeach()
  tack_link(tack_cli)
  tack_link_all(tack_studies)
  target_link_libraries(tack_app PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt CLI11::CLI11)
  foreach(TARGET tack_cli tack_studies)
    target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:tack_app>)
    set_target_properties(${TARGET} PROPERTIES ENABLE_EXPORTS ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
    add_dependencies(${TARGET} tack_msh)
  endforeach()
endfunction()
