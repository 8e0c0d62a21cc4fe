#include "geometry/msh_library.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"
#include "geometry/io/formats.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/msh/functions.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

const MshFunctions& opened() {
  try {
    return *static_cast<const MshFunctions*>(own_library("libtack_msh.so", "tack_msh_functions", TACK_MSH_INTERFACE));
  } catch (const InputError& error) {
    throw InputError(fmt::format(".msh files cannot be read or written: {}; run `./tack`, which builds it, or `cmake --build --preset release "
                                 "--target tack_msh`", error.what()));
  }
}

const MshFunctions& library() {
  static const MshFunctions& functions = opened();
  return functions;
}

}  // namespace

void open_msh_library() { library(); }

Mesh read_msh(const std::filesystem::path& path) {
  precheck_msh(path.string());
  Mesh mesh = library().read(path.string());
  drop_redundant_elements(mesh);
  return mesh;
}

void write_msh(const std::filesystem::path& path, const Mesh& mesh) { library().write(path.string(), mesh); }

}  // namespace tack
