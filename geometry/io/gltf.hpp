// Geometry in glTF 2.0 (Khronos; ISO/IEC 12113): .glb is one binary file, .gltf is JSON with the
// data inside. Metres, y up, single precision.
#pragma once

#include <array>
#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

// Return the file with all elements except tets, without groups.
std::string glb_bytes(const Mesh& mesh);
std::string gltf_text(const Mesh& mesh);

// Returns the first two vertices whose different positions coincide in single precision; {-1, -1}:
// none.
std::array<int, 2> merged_in_single_precision(const Mesh& mesh);

}  // namespace tack
