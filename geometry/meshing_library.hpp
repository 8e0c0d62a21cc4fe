// Shared library of meshing/functions.hpp, beside the program: bin/libtack_meshing.so. The first
// call of one of its functions opens it, and throws InputError, with the remedy, if it is missing
// or of another build.
#pragma once

#include <string>

namespace tack {

// Opens the library now. Call it before a fork, so that the program itself reports the error.
void open_meshing_library();

// Returns size and time of its file, which identify its build; empty: it is missing.
std::string meshing_library_stamp();

}  // namespace tack
