// The files that a scene names, and digests of files, to tell versions of a file apart.
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "framework/config/value.hpp"

namespace tack {

// Returns size and CRC-32 of a file's bytes, "1290-5f3c01aa"; "" unless it is a readable regular
// file.
std::string file_digest(const std::filesystem::path& path);

// Returns the absolute paths that a value of a resolved scene names, each once, in the order of the
// scene. A path may be that of a folder, or of nothing.
std::vector<std::string> named_paths(const Value& value);

// Returns the digest of each file that a resolved scene names by absolute path. Omits the earlier
// run of `start`, which is read only once, before the first step.
std::map<std::string, std::string> file_digests(const Value& scene);

}  // namespace tack
