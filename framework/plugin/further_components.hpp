// Components that most first scenes do without: libtack_further.so, beside the program, has them (cmake/tack_layer.cmake: TACK_FURTHER_FOLDERS). It is
// loaded when one of them is named, listed, or called by a plugin. Programs that are linked with all have none elsewhere.
#pragma once

namespace tack {

// From now on they are known by their names. Before any plugin is loaded.
void note_further_components();

// False: there was nothing left to load. Throws InputError, without a place and with the remedy: not built, broken, or of another build.
bool load_further_components();

// Whether it could not be loaded.
bool further_components_failed();

}  // namespace tack
