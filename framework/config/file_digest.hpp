// Files that a scene reads beside itself, as what tells two versions of one apart.
#pragma once

#include <filesystem>
#include <map>
#include <string>

#include "framework/config/value.hpp"

namespace tack {

// Size and CRC-32 of the bytes of a file, "1290-5f3c01aa"; "" unless it is a regular file that can be read.
std::string file_digest(const std::filesystem::path& path);

// The files that a resolved scene names by their absolute paths, each with its digest. The earlier run of `start` is
// left out: a run reads it once, before its first step.
std::map<std::string, std::string> file_digests(const Value& scene);

}  // namespace tack
