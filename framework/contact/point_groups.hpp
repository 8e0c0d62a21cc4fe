// Groups of candidates by vertex and object: all primitives of one object that may be near one
// vertex are reduced to features together.
#pragma once

#include <array>
#include <vector>

#include "geometry/broad_phase/candidates.hpp"
#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// A vertex, an object, and the runs of candidates between the two.
struct PointGroup {
  int point = 0, object = 0;
  int triangle_begin = 0, triangle_end = 0;  // into candidates.point_triangle
  int edge_begin = 0, edge_end = 0;          // into candidates.point_edge
  int other_begin = 0, other_end = 0;        // into PointGroups::particles

  std::array<int, 2> key() const { return {point, object}; }
};

struct PointGroups {
  std::vector<PointGroup> groups;             // by point, then object
  std::vector<std::array<int, 2>> particles;  // particle candidates in both directions, sorted

  // Groups the candidates.
  void make(const Candidates& candidates, const CollisionMesh& mesh);
};

}  // namespace tack
