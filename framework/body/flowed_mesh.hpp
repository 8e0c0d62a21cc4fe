// Mesh of an object that was remeshed while it flowed: new vertices and tets inside the old
// surface. Each tet stores its stress-free shape, which after flow is no shape of the mesh at the
// start.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/body/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

struct FlowedMesh {
  Mesh mesh;  // vertices where their material was at rest, in the scene's place [m]; tets, positive
              // where they are now
  std::vector<Triangle> surface;          // in the order of the mesh that the run began with
  std::vector<TetReference> references;   // of each tet
};

using FlowedMeshes = std::map<std::string, FlowedMesh>;  // by object

}  // namespace tack
