# bin/tack and what it starts, lib/tack (what these open themselves), lib/libtack.so (all of it as a library) where that was built, include/tack, lib/cmake/tack (find_package(tack)), share/tack (experiments, documents), completions of shells and tack(1).
include(CMakePackageConfigHelpers)
if(TACK_ARCHITECTURE)
  include(tack_package)
else()
  install(TARGETS tack_cli tack_studies tack_further RUNTIME DESTINATION bin LIBRARY DESTINATION lib/tack)
  install(FILES $<TARGET_FILE:tack_library> DESTINATION lib OPTIONAL)
endif()
install(TARGETS tack_meshing tack_msh tack_hdf5 LIBRARY DESTINATION lib/tack)
install(DIRECTORY geometry framework energies solvers DESTINATION include/tack FILES_MATCHING PATTERN "*.hpp"
        PATTERN framework/app EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/generated/framework/plugin/headers_digest.hpp DESTINATION include/tack/framework/plugin)
install(DIRECTORY experiments docs DESTINATION share/tack COMPONENT share PATTERN results EXCLUDE PATTERN docs/site EXCLUDE)
install(FILES ${CMAKE_BINARY_DIR}/share/report.html ${CMAKE_BINARY_DIR}/share/film.html ${CMAKE_BINARY_DIR}/share/render.mjs DESTINATION share/tack COMPONENT share OPTIONAL)
install(DIRECTORY ${CMAKE_BINARY_DIR}/report/node_modules/playwright-core DESTINATION share/tack/node_modules COMPONENT share OPTIONAL)
install(FILES report/blender.py report/blender_runs.py README.md LICENSE DESTINATION share/tack COMPONENT share)
# Completions of shells and the manual page, written by the program.
foreach(SHELL_FILE bash=bash-completion/completions/tack zsh=zsh/site-functions/_tack fish=fish/vendor_completions.d/tack.fish)
  string(REGEX MATCH "^(.*)=(.*)/(.*)$" UNUSED ${SHELL_FILE})
  install(CODE "
    file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/${CMAKE_MATCH_2}\")
    execute_process(COMMAND \"$<TARGET_FILE:tack_cli>\" completion ${CMAKE_MATCH_1} COMMAND_ERROR_IS_FATAL ANY
                    OUTPUT_FILE \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/${CMAKE_MATCH_2}/${CMAKE_MATCH_3}\")")
endforeach()
install(CODE "
  file(MAKE_DIRECTORY \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1\")
  execute_process(COMMAND \"$<TARGET_FILE:tack_cli>\" list --man \"\$ENV{DESTDIR}\${CMAKE_INSTALL_PREFIX}/share/man/man1/tack.1\" COMMAND_ERROR_IS_FATAL ANY)")

set(BINARIES bin)
set(HEADERS include/tack)
set(LIBRARIES lib)
configure_package_config_file(cmake/tackConfig.cmake.in ${CMAKE_BINARY_DIR}/tackConfig.cmake
                              INSTALL_DESTINATION lib/cmake/tack PATH_VARS BINARIES HEADERS LIBRARIES)
write_basic_package_version_file(${CMAKE_BINARY_DIR}/tackConfigVersion.cmake COMPATIBILITY SameMinorVersion)
install(FILES ${CMAKE_BINARY_DIR}/tackConfig.cmake ${CMAKE_BINARY_DIR}/tackConfigVersion.cmake cmake/plugin_note.cpp
        DESTINATION lib/cmake/tack)
