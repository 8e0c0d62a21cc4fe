// The shared library of meshing/functions.hpp, beside the program: bin/libtack_meshing.so. It is
// opened when one of its functions is called for the first time; then InputError, with the remedy,
// if it is not there or of another build.
#pragma once

#include <string>

namespace tack {

// Opens it now: before a process is forked, or what it throws would be told by that.
void open_meshing_library();

// Returns whether it could not be opened.
bool meshing_library_failed();

// Size and time of its file: another build is another library. Empty: it is not there.
std::string meshing_library_stamp();

}  // namespace tack
