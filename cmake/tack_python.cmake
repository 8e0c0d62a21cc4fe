# `import tack`, and `tack` as a command of the same package. libtack.so is all of tack as a library; the extension _tack and the program tack_packaged are
# built on it. The package in the build tree can be imported as it is (PYTHONPATH=build/release/python), is made a wheel of, and installed.
# None of it is a part of `all`.
function(tack_shared_library)
  add_library(tack_library SHARED EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp)
  tack_link_all(tack_library)
  set_target_properties(tack_library PROPERTIES OUTPUT_NAME tack LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/tack/lib)
endfunction()

# tack_packaged: all commands, without code that libtack.so has. Wheels have bin/tack, or bin/ARCHITECTURE/tack for several instruction sets.
function(tack_packaged_program)
  add_executable(tack_packaged EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp $<TARGET_OBJECTS:tack_app> $<TARGET_OBJECTS:tack_study_commands>)
  target_link_libraries(tack_packaged PRIVATE tack_library tack_options TBB::tbb fmt::fmt Threads::Threads)
  set_target_properties(tack_packaged PROPERTIES OUTPUT_NAME tack RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/tack/bin
                        BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/../lib;$ORIGIN/../../lib/${TACK_ARCHITECTURE}")
endfunction()

function(tack_python)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 REQUIRED)
  set(PACKAGE ${CMAKE_BINARY_DIR}/python/tack)
  file(GLOB BINDINGS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/bindings/*.cpp)
  pybind11_add_module(tack_extension MODULE EXCLUDE_FROM_ALL NO_EXTRAS ${BINDINGS})
  target_link_libraries(tack_extension PRIVATE tack_library tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
  target_compile_options(tack_extension PRIVATE ${TACK_COLD_OPTIONS})
  set_target_properties(tack_extension PROPERTIES OUTPUT_NAME _tack LIBRARY_OUTPUT_DIRECTORY ${PACKAGE} BUILD_WITH_INSTALL_RPATH ON INSTALL_RPATH "$ORIGIN/lib")

  file(GLOB MODULES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/tack/*.py ${CMAKE_SOURCE_DIR}/python/tack/*.pyi ${CMAKE_SOURCE_DIR}/python/tack/py.typed)
  add_custom_target(tack_python DEPENDS tack_extension tack_meshing tack_msh tack_hdf5 VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PACKAGE}/lib/tack ${PACKAGE}/share
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${MODULES} ${PACKAGE}
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${CMAKE_SOURCE_DIR}/python/tack_program.py ${CMAKE_BINARY_DIR}/python
    COMMAND ${CMAKE_COMMAND} -E copy_if_different $<TARGET_FILE:tack_meshing> $<TARGET_FILE:tack_msh> $<TARGET_FILE:tack_hdf5> ${PACKAGE}/lib/tack
    COMMAND ${CMAKE_COMMAND} -D FROM=${CMAKE_BINARY_DIR}/share/report.html -D TO=${PACKAGE}/share/report.html -P ${CMAKE_SOURCE_DIR}/cmake/copy_if_there.cmake)
  # The folder that a wheel is made of: the package, and what an installation has in share/tack.
  set(STAGE ${CMAKE_BINARY_DIR}/python/stage)
  add_custom_target(tack_wheel_stage DEPENDS tack_python tack_packaged VERBATIM
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${STAGE}
    COMMAND ${CMAKE_COMMAND} -E copy_directory ${PACKAGE} ${STAGE}/tack
    COMMAND ${CMAKE_COMMAND} -E rm -rf ${STAGE}/tack/__pycache__ ${STAGE}/tack/share
    COMMAND ${CMAKE_COMMAND} -E copy ${CMAKE_SOURCE_DIR}/python/setup.py ${CMAKE_SOURCE_DIR}/python/tack_program.py ${CMAKE_SOURCE_DIR}/LICENSE ${STAGE}
    COMMAND ${CMAKE_COMMAND} --install ${CMAKE_BINARY_DIR} --component share --prefix ${STAGE}/tack)
  set(WHEEL ${CMAKE_BINARY_DIR}/python/wheel)
  add_custom_target(tack_wheel DEPENDS tack_wheel_stage VERBATIM
    COMMAND ${CMAKE_COMMAND} -E env TACK_VERSION=${PROJECT_VERSION} ${Python3_EXECUTABLE} -m pip wheel --quiet --no-deps --no-build-isolation
            --disable-pip-version-check --wheel-dir ${WHEEL} ${STAGE})
  if(NOT TACK_ARCHITECTURE)  # packages: packaging/python_deb.sh, packaging/wheel.sh
    set(MODULES lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages)
    install(DIRECTORY ${PACKAGE} DESTINATION ${MODULES} COMPONENT python OPTIONAL PATTERN __pycache__ EXCLUDE PATTERN bin EXCLUDE)
    install(FILES ${CMAKE_BINARY_DIR}/python/tack_program.py DESTINATION ${MODULES} COMPONENT python OPTIONAL)
  endif()
endfunction()

tack_shared_library()
tack_packaged_program()
option(TACK_PYTHON "Make what `import tack` needs: the target tack_python (needs pybind11 and NumPy)" OFF)
if(TACK_PYTHON)
  tack_python()
endif()
