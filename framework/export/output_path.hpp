// Protection of files that an export did not write.
#pragma once

#include <filesystem>
#include <vector>

namespace tack {

// Throws InputError, with the remedy, if an export to `output` could replace a file that the scene
// reads, or that no export wrote. A folder must be new, empty, or one that an export has filled
// (mark_exported); a file must be none of `sources`, the files of the scene.
void check_file_output(const std::filesystem::path& output,
                       const std::vector<std::filesystem::path>& sources);
void check_folder_output(const std::filesystem::path& output,
                         const std::vector<std::filesystem::path>& sources);

// Makes a folder, and the hidden file .tack_export in it, by which later exports know it. Throws
// InputError.
void mark_exported(const std::filesystem::path& folder);

}  // namespace tack
