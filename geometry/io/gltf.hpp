// glTF 2.0 (Khronos; ISO/IEC 12113), its geometry alone: .glb is one binary file, .gltf JSON with the data inside. Metres, y up, single precision.
#pragma once

#include <array>
#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// All but tets and groups, over one list of vertices.
std::string glb_bytes(const Mesh& mesh);
std::string gltf_text(const Mesh& mesh);

// The first two vertices, by number, that lie apart and would be in one place; {-1, -1}: there are none.
std::array<int, 2> merged_in_single_precision(const Mesh& mesh);

}  // namespace tack
