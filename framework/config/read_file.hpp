// Reads a whole file into memory. Devices, pipes, folders and files above a size limit are errors,
// because reading them might not end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tack {

inline constexpr std::uintmax_t largest_text = 64u << 20;  // limit of a scene file [bytes]

// Throws InputError, "PATH: cannot read this file...", with reason and remedy.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest);

}  // namespace tack
