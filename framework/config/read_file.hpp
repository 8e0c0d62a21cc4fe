// A whole file in memory. Devices, pipes and folders are refused, and files of a size that nothing sensible
// has: reading them would not end.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string>

namespace tack {

inline constexpr std::uintmax_t largest_text = 64u << 20;  // bytes, of a scene file

// Throws InputError, "PATH: cannot read this file...", with the reason and the remedy.
std::string read_file(const std::filesystem::path& path, std::uintmax_t largest);

}  // namespace tack
