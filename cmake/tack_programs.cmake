# The programs, their build information, and the page of reports.
include_guard()

# tack_build_info(): commit, compiler and options of the build, for every summary.json. Read again at each build.
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

# tack_report_page(): the target tack_report, pages for `tack report` and `tack render`, made of report/ and of libraries that npm fetches. It is not
# in `all`: everything else is built without npm and without a network. npm and node are looked for when it is made: `./tack` may have installed them
# after cmake ran.
function(tack_report_page)
  set(MODULES ${CMAKE_BINARY_DIR}/report)
  set(PAGE ${CMAKE_BINARY_DIR}/share/report.html)
  set(SOURCE ${CMAKE_SOURCE_DIR}/report)
  foreach(SCRIPT blender blender_runs)
    configure_file(${SOURCE}/${SCRIPT}.py ${CMAKE_BINARY_DIR}/share/${SCRIPT}.py COPYONLY)
  endforeach()
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

# tack_program(TARGET SOURCE...): a program of the sources and of those that both programs have (the target tack_app), in bin/.
function(tack_program TARGET)
  add_executable(${TARGET} ${ARGN})
  tack_compile_cold(${TARGET})
  tack_precompile_cold(${TARGET})
  target_sources(${TARGET} PRIVATE $<TARGET_OBJECTS:tack_app>)
  set_target_properties(${TARGET} PROPERTIES ENABLE_EXPORTS ON RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/bin)
endfunction()

# tack_app(): the program tack, for the commands that first scenes need. It starts tack_studies for the others.
function(tack_app)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/app/*.cpp)
  list(JOIN TACK_STUDY_COMMANDS "|" COMMANDS)
  list(FILTER SOURCES EXCLUDE REGEX "/((${COMMANDS})_command|in_studies).cpp$")
  add_library(tack_app OBJECT ${SOURCES})
  tack_compile_cold(tack_app)
  tack_precompile_cold(tack_app)
  target_link_libraries(tack_app PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt CLI11::CLI11)
  tack_program(tack_cli ${CMAKE_SOURCE_DIR}/framework/app/in_studies.cpp)
  set_target_properties(tack_cli PROPERTIES OUTPUT_NAME tack)
  tack_link_core(tack_cli)
  # Templates, stored steps and documents, which an installation has in share/tack.
  file(MAKE_DIRECTORY ${CMAKE_BINARY_DIR}/share)
  foreach(FOLDER experiments docs)
    file(CREATE_LINK ${CMAKE_SOURCE_DIR}/${FOLDER} ${CMAKE_BINARY_DIR}/share/${FOLDER} SYMBOLIC)
  endforeach()
endfunction()

# tack_studies(): the program tack_studies, with all commands. The target tack_study_commands has the sources of those that the program tack lacks.
function(tack_studies)
  file(GLOB SOURCES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/framework/app/*_command.cpp)
  list(JOIN TACK_STUDY_COMMANDS "|" COMMANDS)
  list(FILTER SOURCES INCLUDE REGEX "/(${COMMANDS})_command.cpp$")
  add_library(tack_study_commands OBJECT ${SOURCES})
  tack_compile_cold(tack_study_commands)
  tack_precompile_cold(tack_study_commands)
  target_link_libraries(tack_study_commands PRIVATE tack_options Eigen3::Eigen TBB::tbb fmt::fmt CLI11::CLI11)
  tack_program(tack_studies ${CMAKE_BINARY_DIR}/precompiled.cpp)
  target_sources(tack_studies PRIVATE $<TARGET_OBJECTS:tack_study_commands>)
  tack_link_all(tack_studies)
endfunction()
