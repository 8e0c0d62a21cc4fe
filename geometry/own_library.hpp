// Shared libraries of tack that the program opens on demand: beside it in bin/, or in lib/tack of
// an installation.
#pragma once

#include <filesystem>
#include <string>

namespace tack {

// Returns the file that contains this code: the program, or libtack.so in another program.
std::filesystem::path own_file();
// Returns the nearest folder above that of the program (bin/) or library (lib/) that holds share/;
// without one the parent of bin/ or lib/.
std::filesystem::path own_root();

// Returns the path of a file in share/, or in share/tack/ of an installation.
std::filesystem::path shared_file(const std::string& name);

// Returns true for an installation, false for a build tree.
bool is_installed();

// Returns how to get a part of the program that is not there: "run `./tack`, which builds it, or
// `cmake --build --preset release --target TARGET`" for a build tree, "install tack again" for an
// installation. script: the command that builds it.
std::string remedy_for_missing(const std::string& target, const std::string& script = "./tack");

std::filesystem::path own_library_path(const std::string& name);

struct OwnLibrary {
  const char* file;   // "libtack_msh.so"
  const char* table;  // symbol of its function table, which begins with the text `interface`
  const char* interface;
  const char* target;   // CMake target that builds it
  const char* without;  // consequence of its absence: ".msh files cannot be read or written"
};

// Opens the library for the rest of the process and returns its function table. Throws InputError,
// with the remedy, if it is not built, broken, or of another build.
const void* open_library(const OwnLibrary& library);

// Returns the CMake target of the library that could not be opened; "": none.
const char* missing_library();

}  // namespace tack
