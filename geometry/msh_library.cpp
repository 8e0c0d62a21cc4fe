#include "geometry/msh_library.hpp"

#include "geometry/io/formats.hpp"
#include "geometry/io/precheck.hpp"
#include "geometry/mesh/cleanup.hpp"
#include "geometry/msh/functions.hpp"
#include "geometry/own_library.hpp"

namespace tack {
namespace {

constexpr OwnLibrary own{"libtack_msh.so", "tack_msh_functions", TACK_MSH_INTERFACE, "tack_msh", ".msh files cannot be read or written"};

const MshFunctions& library() {
  static const MshFunctions& functions = *static_cast<const MshFunctions*>(open_library(own));
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
