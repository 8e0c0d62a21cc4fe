// Reads sections of a shared library (ELF, 64 bits) without loading it.
#pragma once

#include <optional>
#include <string>

namespace tack {

// Returns the content of a section; nothing if the section does not exist. Throws InputError,
// without a source location, if the file cannot be read, is no shared library, or is damaged.
std::optional<std::string> library_section(const std::string& path, const std::string& section);

}  // namespace tack
