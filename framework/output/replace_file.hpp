// Whole files, written so that an interrupted run leaves either the old content or the new.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tack {

// Writes "<path>.part" beside the file and renames it. Throws InputError naming the path and the
// system's reason.
void replace_file(const std::filesystem::path& path, std::string_view content);

// "<path>: cannot be written (<reason>): <remedy>", with the reason of the last failed system call.
std::string write_failure(const std::filesystem::path& path);

}  // namespace tack
