// Less common components, in libtack_further.so beside the program (cmake/tack_layer.cmake:
// TACK_FURTHER_FOLDERS). The library is loaded when one of its components is named or listed, or
// when a plugin calls one. In programs that link all components these functions do nothing.
#pragma once

namespace tack {

// Registers the names of the further components. Call it before any plugin is loaded.
void declare_further_components();

// Loads the library; returns false if there was nothing left to load. Throws InputError, without a
// source location and with the remedy, if the library is not built, is broken, or is of another
// build.
bool load_further_components();

// Returns true if the library could not be loaded.
bool further_components_failed();

}  // namespace tack
