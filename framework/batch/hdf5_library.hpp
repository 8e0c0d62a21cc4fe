// Shared library of geometry/hdf5/functions.hpp. The first table as HDF5 opens it.
#pragma once

#include <filesystem>
#include <vector>

#include "geometry/hdf5/functions.hpp"

namespace tack {

// Opens the library now, so that a long batch does not miss it in the end. Throws InputError if it
// is missing or of another build.
void open_hdf5_library();

// Writes a table; replaces the file as a whole. Throws InputError if it cannot be written.
void write_hdf5_table(const std::filesystem::path& path, const Hdf5Attributes& attributes,
                      const std::vector<Hdf5Column>& columns);

}  // namespace tack
