#include "framework/batch/hdf5_library.hpp"

#include "geometry/io/replace_file.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

constexpr OwnLibrary own{"libtack_hdf5.so", "tack_hdf5_functions", TACK_HDF5_INTERFACE, "tack_hdf5", "tables cannot be written as HDF5"};

const Hdf5Functions& library() {
  static const Hdf5Functions& functions = *static_cast<const Hdf5Functions*>(open_library(own));
  return functions;
}

}  // namespace

void open_hdf5_library() { library(); }

void write_hdf5_table(const std::filesystem::path& path, const Hdf5Attributes& attributes, const std::vector<Hdf5Column>& columns) {
  const Hdf5Functions& functions = library();
  replace_file_by(path, [&](const std::filesystem::path& draft) { return functions.write_table(draft.string(), attributes, columns); });
}

}  // namespace tack
