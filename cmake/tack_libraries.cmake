# Libraries that the programs load on demand.
include_guard()

# tack_own_library(NAME [CALLER FILE] SOURCES ... HEADERS ... LINKS ...): libtack_NAME.so beside the program. geometry/NAME/functions.hpp has the table
# of its functions, CALLER (geometry/NAME_library.cpp) calls them. The program refuses a library that was built from other HEADERS, or in another way.
# With TACK_FIRST there is the program's side alone.
function(tack_own_library NAME)
  cmake_parse_arguments(L "" "CALLER" "SOURCES;HEADERS;LINKS" ${ARGN})
  if(NOT L_CALLER)
    set(L_CALLER geometry/${NAME}_library.cpp)
  endif()
  if(NOT TACK_FIRST)
    add_library(tack_${NAME} MODULE ${L_SOURCES})
    tack_compile_cold(tack_${NAME})
    # Hidden, because the program has functions of the same names.
    set_target_properties(tack_${NAME} PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin CXX_VISIBILITY_PRESET hidden)
    target_link_libraries(tack_${NAME} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt ${L_LINKS})
    target_link_options(tack_${NAME} PRIVATE $<$<NOT:$<BOOL:${TACK_SANITIZE}>>:-Wl,--no-undefined>)
  endif()
  set_property(DIRECTORY APPEND PROPERTY CMAKE_CONFIGURE_DEPENDS ${L_HEADERS})
  set(ALL "${CMAKE_CXX_COMPILER_VERSION} ${CMAKE_BUILD_TYPE} ${CMAKE_CXX_FLAGS} ${TACK_NATIVE} ${TACK_SANITIZE}")
  foreach(HEADER ${L_HEADERS})
    file(SHA256 ${HEADER} DIGEST)
    string(APPEND ALL ${DIGEST})
  endforeach()
  string(SHA256 DIGEST "${ALL}")
  string(TOUPPER ${NAME} UPPER)
  set_source_files_properties(${CMAKE_SOURCE_DIR}/geometry/${NAME}/functions.cpp ${CMAKE_SOURCE_DIR}/${L_CALLER}
                              PROPERTIES COMPILE_DEFINITIONS TACK_${UPPER}_INTERFACE="${DIGEST}" SKIP_UNITY_BUILD_INCLUSION ON)
endfunction()

# libtack_meshing.so: operations of CGAL and grids of OpenVDB, with its own copies of the files of geometry/mesh that they use.
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

# libtack_msh.so: reads and writes mesh files with Gmsh, which takes longer to load than all other libraries together.
function(tack_msh_library)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/msh/*.cpp)
  file(GLOB HEADERS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/msh/*.hpp ${CMAKE_SOURCE_DIR}/geometry/types.hpp
       ${CMAKE_SOURCE_DIR}/geometry/errors.hpp ${CMAKE_SOURCE_DIR}/geometry/mesh/mesh.hpp)
  tack_own_library(msh SOURCES ${SOURCES} HEADERS ${HEADERS} LINKS ${TACK_GMSH})
endfunction()

# libtack_hdf5.so: tables of batches as HDF5 files.
function(tack_hdf5_library)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/hdf5/*.cpp)
  file(GLOB HEADERS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/geometry/hdf5/*.hpp)
  tack_own_library(hdf5 CALLER framework/batch/hdf5_library.cpp SOURCES ${SOURCES} HEADERS ${HEADERS} LINKS ${HDF5_LIBRARY})
  if(NOT TACK_FIRST)
    target_include_directories(tack_hdf5 SYSTEM PRIVATE ${HDF5_INCLUDE})
  endif()
endfunction()

# libtack_further.so: further components (tack_folders.cmake). It calls functions of the program that loads it, as a plugin does.
function(tack_further_library)
  add_library(tack_further MODULE ${CMAKE_SOURCE_DIR}/cmake/plugin_note.cpp)
  tack_add_objects(tack_further FURTHER)
  target_link_libraries(tack_further PRIVATE ${TACK_EXTERNAL_MINIMISERS})
  set_target_properties(tack_further PROPERTIES LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
  target_include_directories(tack_further PRIVATE ${CMAKE_BINARY_DIR}/generated)
  add_dependencies(tack_further tack_build_info)
endfunction()
