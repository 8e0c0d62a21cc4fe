// Atomic replacement of files: an interrupted run or a full disk leaves either the old content or
// the new.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tack {

// Writes "<path>.part" beside the file and renames it. Throws InputError naming the path and the
// system's reason. A device or a pipe, as /dev/stdout, stays, and is written to.
void replace_file(const std::filesystem::path& path, std::string_view content);

// Replaces a file by one that `write` creates at the path that it gets, which has the extension of
// the real one. `write` returns whether all of it was written.
void replace_file_by(const std::filesystem::path& path,
                     const std::function<bool(const std::filesystem::path&)>& write);

// "<path>: cannot be written (<reason>): <remedy>", with the reason of the last failed system call.
std::string write_failure(const std::filesystem::path& path);

}  // namespace tack
