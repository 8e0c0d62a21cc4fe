// Atomic replacement of files: after an interrupted run or on a full disk, a file has either its
// old content or the new.
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <string_view>

namespace tack {

// Writes "<path>.part" beside the file and renames it; devices and pipes such as /dev/stdout are
// written directly. Throws InputError naming the path and the system's reason.
void replace_file(const std::filesystem::path& path, std::string_view content);

// Replaces a file by one that `write` creates at the path passed to it, which has the same
// extension. `write` returns true if the file is complete.
void replace_file_by(const std::filesystem::path& path,
                     const std::function<bool(const std::filesystem::path&)>& write);

// Returns "<path>: cannot be written (<reason>): <remedy>", with the reason of the last failed
// system call.
std::string write_failure(const std::filesystem::path& path);

}  // namespace tack
