# Contents of packages: packaging/deb.sh configures a build for each TACK_ARCHITECTURE, and puts them into one. The builds differ in their programs only; all else
# comes from the first.
install(TARGETS tack_cli tack_studies tack_further RUNTIME DESTINATION libexec/tack/${TACK_ARCHITECTURE}/bin LIBRARY DESTINATION libexec/tack/${TACK_ARCHITECTURE}/bin COMPONENT program)
# They look for the rest beside themselves.
foreach(LINK lib share)
  install(CODE "file(CREATE_LINK ../../../${LINK} \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/libexec/tack/${TACK_ARCHITECTURE}/${LINK}\" SYMBOLIC)" COMPONENT program)
endforeach()

add_executable(tack_launcher packaging/launcher.cpp)
set_target_properties(tack_launcher PROPERTIES OUTPUT_NAME tack RUNTIME_OUTPUT_DIRECTORY ${CMAKE_BINARY_DIR}/launcher)
target_compile_options(tack_launcher PRIVATE -Wall -Wextra)
target_link_options(tack_launcher PRIVATE -static-libstdc++ -static-libgcc)
install(TARGETS tack_launcher RUNTIME DESTINATION bin)

file(READ LICENSE LICENSE_TEXT)
configure_file(packaging/copyright ${CMAKE_BINARY_DIR}/copyright @ONLY)
install(FILES ${CMAKE_BINARY_DIR}/copyright DESTINATION share/doc/tack)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_CONTACT "tack maintainers <tack@localhost>")
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_STRIP_FILES ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_PACKAGE_SECTION science)
set(CPACK_DEBIAN_PACKAGE_DESCRIPTION "Simulates adhesive and frictional contact between deformable solids, sheets, rods and particles, and makes meshes for it. The program
is there for several instruction sets; the best that the processor has is taken.")
set(CPACK_DEBIAN_PACKAGE_RECOMMENDS "gnuplot-nox")  # plots
set(CPACK_DEBIAN_PACKAGE_SUGGESTS "nodejs, chromium, ffmpeg, g++, cmake, libeigen3-dev, libtbb-dev, libfmt-dev")  # pictures and films; plugins
# Builds that were configured beside this one, by packaging/deb.sh.
set(TACK_PACKAGED "" CACHE STRING "Build folders of the other architectures of a package")
set(CPACK_INSTALL_CMAKE_PROJECTS "${CMAKE_BINARY_DIR};tack;ALL;/")
foreach(FOLDER ${TACK_PACKAGED})
  list(APPEND CPACK_INSTALL_CMAKE_PROJECTS "${FOLDER};tack;program;/")
endforeach()
include(CPack)
