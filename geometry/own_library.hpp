// Shared libraries of tack's own that the program opens when it needs them: beside it in bin/, or
// in lib/tack where tack is installed.
#pragma once

#include <filesystem>
#include <string>

namespace tack {

// The file that this code is in: a program, or libtack.so in one of others.
std::filesystem::path own_file();
// Returns the parent of the folder that holds the program (bin/) or library (lib/), beside share/.
std::filesystem::path own_root();

// Returns the path of that name there, or in share/tack/ where tack is installed.
std::filesystem::path shared_file(const std::string& name);

std::filesystem::path own_library_path(const std::string& name);

struct OwnLibrary {
  const char* file;       // "libtack_msh.so"
  const char* table;      // of its functions; it begins with a text that has to be `interface`
  const char* interface;
  const char* target;     // that builds it
  const char* without;    // what cannot be done without it: ".msh files cannot be read or written"
};

// Opens it, for good, and returns its table of functions. Throws InputError, with the remedy: not
// built, broken, or of another build.
const void* open_library(const OwnLibrary& library);

}  // namespace tack
