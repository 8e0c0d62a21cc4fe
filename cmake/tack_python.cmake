# `import tack`. libtack.so is all of tack as a library; the extension _tack is built on it, and both make up the package in the build tree, which can be
# imported as it is (PYTHONPATH=build/release/python), is made a wheel of, and installed. Neither is a part of `all`.
function(tack_shared_library)
  add_library(tack_library SHARED EXCLUDE_FROM_ALL ${CMAKE_BINARY_DIR}/precompiled.cpp)
  tack_link_all(tack_library)
  set_target_properties(tack_library PROPERTIES OUTPUT_NAME tack LIBRARY_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/python/tack/lib)
endfunction()

function(tack_python)
  find_package(Python3 3.9 REQUIRED COMPONENTS Interpreter Development.Module)
  find_package(pybind11 2.10 REQUIRED)
  set(PACKAGE ${CMAKE_BINARY_DIR}/python/tack)
  file(GLOB BINDINGS CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/bindings/*.cpp)
  pybind11_add_module(tack_extension MODULE EXCLUDE_FROM_ALL NO_EXTRAS ${BINDINGS})
  target_link_libraries(tack_extension PRIVATE tack_library tack_options Eigen3::Eigen TBB::tbb fmt::fmt)
  target_compile_options(tack_extension PRIVATE ${TACK_COLD_OPTIONS})
  set_target_properties(tack_extension PROPERTIES OUTPUT_NAME _tack LIBRARY_OUTPUT_DIRECTORY ${PACKAGE} BUILD_RPATH "$ORIGIN/lib" INSTALL_RPATH "$ORIGIN/lib")

  file(GLOB MODULES CONFIGURE_DEPENDS ${CMAKE_SOURCE_DIR}/python/tack/*.py ${CMAKE_SOURCE_DIR}/python/tack/*.pyi)
  add_custom_target(tack_python DEPENDS tack_extension tack_meshing tack_msh VERBATIM
    COMMAND ${CMAKE_COMMAND} -E make_directory ${PACKAGE}/lib/tack ${PACKAGE}/share
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${MODULES} ${PACKAGE}
    COMMAND ${CMAKE_COMMAND} -E copy_if_different $<TARGET_FILE:tack_meshing> $<TARGET_FILE:tack_msh> ${PACKAGE}/lib/tack
    COMMAND ${CMAKE_COMMAND} -D FROM=${CMAKE_BINARY_DIR}/share/report.html -D TO=${PACKAGE}/share/report.html -P ${CMAKE_SOURCE_DIR}/cmake/copy_if_there.cmake)
  set(WHEEL ${CMAKE_BINARY_DIR}/python/wheel)
  add_custom_target(tack_wheel DEPENDS tack_python VERBATIM
    COMMAND ${CMAKE_COMMAND} -E copy_if_different ${CMAKE_SOURCE_DIR}/python/setup.py ${CMAKE_BINARY_DIR}/python
    COMMAND ${CMAKE_COMMAND} -E env TACK_VERSION=${PROJECT_VERSION} ${Python3_EXECUTABLE} -m pip wheel --quiet --no-deps --no-build-isolation
            --disable-pip-version-check --wheel-dir ${WHEEL} ${CMAKE_BINARY_DIR}/python)
  install(DIRECTORY ${PACKAGE} DESTINATION lib/python${Python3_VERSION_MAJOR}.${Python3_VERSION_MINOR}/site-packages COMPONENT python OPTIONAL
          PATTERN __pycache__ EXCLUDE)
endfunction()

tack_shared_library()
option(TACK_PYTHON "Make what `import tack` needs: the target tack_python (needs pybind11 and NumPy)" OFF)
if(TACK_PYTHON)
  tack_python()
endif()
