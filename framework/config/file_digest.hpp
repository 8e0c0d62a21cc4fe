// Digests of the files that a scene reads, to tell versions of a file apart.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/config/value.hpp"

namespace tack {

// Returns size and CRC-32 of a file's bytes, "1290-5f3c01aa"; "" unless it is a readable regular
// file.
std::string file_digest(const std::filesystem::path& path);

// Returns the digest of each file that a resolved scene names by absolute path. Omits the earlier
// run of `start`, which is read only once, before the first step.
std::map<std::string, std::string> file_digests(const Value& scene);

}  // namespace tack
