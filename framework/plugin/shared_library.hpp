// A look into the file of a shared library (ELF, 64 bits) without loading it.
#pragma once

#include <optional>
#include <string>

namespace tack {

// The content of a section; nothing if there is none. Throws InputError, without a place, if the file cannot be read, is no
// shared library, or is damaged.
std::optional<std::string> library_section(const std::string& path, const std::string& section);

}  // namespace tack
