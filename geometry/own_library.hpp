// Shared libraries of tack's own that the program opens when it needs them: beside it in bin/, or in lib/tack where tack is installed.
#pragma once

#include <filesystem>
#include <string>

namespace tack {

std::filesystem::path own_library_path(const std::string& name);

// Opens it, for good, and returns its table of functions. The table begins with a text that has to be `interface`. Throws InputError
// without a remedy: not built, broken, or of another build.
const void* own_library(const std::string& name, const char* table, const char* interface);

}  // namespace tack
