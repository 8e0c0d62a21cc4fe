# Object libraries of the four layers geometry, framework, energies and solvers, and how programs and libraries are linked from them.
#
# Each layer has up to four kinds of objects (docs/developer/building.md, tack_folders.cmake):
#   hot      -O3: code that runs in every iteration
#   further  as hot: components that most first scenes do without; libtack_further.so has them
#   cold     -O1: code that parses, describes, sets up and writes
#   studies  as cold: commands that start from runs or laws; the program tack_studies has them
# tack_layer(NAME) makes the object libraries tack_NAME (hot), tack_NAME_further, tack_NAME_cold and tack_NAME_studies.
# tack_link_core(TARGET) links hot and cold objects, tack_link_all(TARGET) links all four kinds.
#
# Objects are not put into archives: components register themselves by static initialisers, which a linker drops from an archive.
# Sources are globbed: a new file in the right folder is enough.
include_guard()
include(tack_options)
include(tack_folders)
include(tack_unity)

# tack_sources_of(OUTPUT SOURCES FOLDER...): sets OUTPUT to the sources that lie in one of the folders.
function(tack_sources_of OUTPUT SOURCES)
  list(JOIN ARGN "|" FOLDERS)
  list(FILTER SOURCES INCLUDE REGEX "/(${FOLDERS})/")
  set(${OUTPUT} ${SOURCES} PARENT_SCOPE)
endfunction()

# tack_layer(NAME [EXCLUDE FOLDER ...] [LINKS ...] [PRIVATE_LINKS ...]): object libraries of the sources below NAME/, without those in the folders
# EXCLUDE. LINKS are public; PRIVATE_LINKS are also linked into the programs that use the layer.
function(tack_layer NAME)
  cmake_parse_arguments(L "" "" "EXCLUDE;LINKS;PRIVATE_LINKS" ${ARGN})

  # 1. Sort the sources by kind. Hot sources are those that no list names.
  file(GLOB_RECURSE HOT CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/${NAME}/*.cpp)
  foreach(FOLDER ${L_EXCLUDE})
    list(FILTER HOT EXCLUDE REGEX "/${NAME}/${FOLDER}/")
  endforeach()
  tack_sources_of(STUDIES "${HOT}" ${TACK_STUDY_FOLDERS})
  tack_sources_of(COLD "${HOT}" ${TACK_COLD_FOLDERS})
  tack_sources_of(FURTHER "${HOT}" ${TACK_FURTHER_FOLDERS})
  list(TRANSFORM TACK_FURTHER_EXCEPT PREPEND ${CMAKE_SOURCE_DIR}/ OUTPUT_VARIABLE FURTHER_EXCEPT)
  list(REMOVE_ITEM FURTHER ${FURTHER_EXCEPT})
  list(REMOVE_ITEM HOT ${COLD} ${FURTHER})
  list(REMOVE_ITEM COLD ${STUDIES})

  # 2. Make an object library of each kind. The global property TACK_<KIND>_OBJECTS collects them over all layers.
  add_library(tack_${NAME} OBJECT ${HOT})
  tack_unity_groups(tack_${NAME} 10 ${TACK_UNITY_FOLDERS})
  target_precompile_headers(tack_${NAME} REUSE_FROM tack_precompiled)
  set_property(GLOBAL APPEND PROPERTY TACK_HOT_OBJECTS tack_${NAME})
  set(TARGETS tack_${NAME})
  if(FURTHER)
    add_library(tack_${NAME}_further OBJECT ${FURTHER})
    tack_unity_groups(tack_${NAME}_further 10)
    target_compile_options(tack_${NAME}_further PRIVATE ${TACK_UNITY_OPTIONS})
    target_precompile_headers(tack_${NAME}_further REUSE_FROM tack_precompiled)
    set_property(GLOBAL APPEND PROPERTY TACK_FURTHER_OBJECTS tack_${NAME}_further)
    list(APPEND TARGETS tack_${NAME}_further)
  endif()
  foreach(KIND COLD STUDIES)
    if(${KIND})
      string(TOLOWER tack_${NAME}_${KIND} TARGET)
      add_library(${TARGET} OBJECT ${${KIND}})
      tack_compile_cold(${TARGET})
      tack_precompile_cold(${TARGET})
      set_property(GLOBAL APPEND PROPERTY TACK_${KIND}_OBJECTS ${TARGET})
      list(APPEND TARGETS ${TARGET})
    endif()
  endforeach()

  # 3. Libraries of the layer. With TACK_FIRST nothing takes those of the other two kinds.
  foreach(TARGET ${TARGETS})
    if(TACK_FIRST AND "${TARGET}" MATCHES "_(further|studies)$")
      set_target_properties(${TARGET} PROPERTIES EXCLUDE_FROM_ALL ON)
    endif()
    target_link_libraries(${TARGET} PUBLIC tack_options ${L_LINKS} PRIVATE ${L_PRIVATE_LINKS})
  endforeach()
  set_property(GLOBAL APPEND PROPERTY TACK_LINKS ${L_PRIVATE_LINKS})
endfunction()

# tack_add_objects(TARGET KIND...): adds the objects of these kinds, of all layers, to TARGET. TARGET exports the functions of tack alone, to plugins
# and libraries that it loads (exports.map).
function(tack_add_objects TARGET)
  set_target_properties(${TARGET} PROPERTIES LINK_DEPENDS ${CMAKE_SOURCE_DIR}/cmake/exports.map)
  target_link_options(${TARGET} PRIVATE -Wl,--version-script=${CMAKE_SOURCE_DIR}/cmake/exports.map)
  foreach(KIND ${ARGN})
    get_property(LIBRARIES GLOBAL PROPERTY TACK_${KIND}_OBJECTS)
    foreach(LIBRARY ${LIBRARIES})
      target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:${LIBRARY}>)
    endforeach()
  endforeach()
  target_link_libraries(${TARGET} PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
endfunction()

# tack_link_objects(TARGET KIND...): adds the objects of these kinds and links the libraries that the layers use. HOT comes first, because the linker
# keeps the first copy of an inline function.
function(tack_link_objects TARGET)
  tack_add_objects(${TARGET} ${ARGN})
  get_property(LINKS GLOBAL PROPERTY TACK_LINKS)
  target_link_libraries(${TARGET} PRIVATE CLI11::CLI11 Threads::Threads ${LINKS})
endfunction()

# tack_link_core(TARGET): the objects of the program tack.
function(tack_link_core TARGET)
  tack_link_objects(${TARGET} HOT COLD)
endfunction()

# tack_link_all(TARGET): the objects of tack_studies, libtack.so and the tests.
function(tack_link_all TARGET)
  tack_link_objects(${TARGET} HOT FURTHER COLD STUDIES)
  target_link_libraries(${TARGET} PRIVATE ${TACK_EXTERNAL_MINIMISERS})
endfunction()
