// The mesh of an object that was meshed anew while it flowed: other vertices and tets inside the same surface. What is stored of each
// tet is where it would be without stress, which is no longer where anything was when the run began.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "framework/body/body.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

struct FlowedMesh {
  Mesh mesh;  // vertices where their material was at rest, in the scene's place [m]; tets, positive where they are now
  std::vector<Triangle> surface;          // in the order of the mesh that the run began with
  std::vector<TetReference> references;   // of each tet
};

using FlowedMeshes = std::map<std::string, FlowedMesh>;  // by object

}  // namespace tack
