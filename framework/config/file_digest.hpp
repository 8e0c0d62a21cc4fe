// Digests of the files that a scene reads beside itself, to tell two versions of a file apart.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/config/value.hpp"

namespace tack {

// Returns the size and CRC-32 of the bytes of a file, "1290-5f3c01aa"; "" unless it is a regular
// file that can be read.
std::string file_digest(const std::filesystem::path& path);

// Returns the digest of each file that a resolved scene names by its absolute path. The earlier run
// of `start` is left out: a run reads it once, before its first step.
std::map<std::string, std::string> file_digests(const Value& scene);

}  // namespace tack
