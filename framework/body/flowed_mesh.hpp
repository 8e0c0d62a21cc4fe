// Mesh of an object that was remeshed while it flowed: new vertices and tets inside the old
// surface. Each tet stores its stress-free shape, which after flow differs from its shape at the
// start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/body/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

struct FlowedMesh {
  // Vertices at the rest positions of their material, in the scene [m]; tets with positive volumes
  // at the present positions.
  Mesh mesh;
  std::vector<Triangle> surface;         // in the order of the first mesh of the run
  std::vector<TetReference> references;  // of each tet
};

using FlowedMeshes = std::map<std::string, FlowedMesh>;  // by object

}  // namespace tack
