// Surface complex for contact: the vertices, edges and triangles of every object, as indices into
// the global configuration. Topology only; positions [m] are passed with each call.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct CollisionMesh {
  std::vector<int> vertices;         // global ids of the surface vertices, ascending
  std::vector<Edge> edges;           // global vertex ids
  std::vector<Triangle> triangles;   // global vertex ids, oriented outwards where closed
  std::vector<int> vertex_object;    // per global vertex: object id, also for interior vertices
  std::vector<char> vertex_movable;  // per global vertex: 0 if it never moves
  // Rigid group per global vertex: vertices of one group (>= 0) keep their distances; -1: in no
  // group. Empty: no groups except the vertices that never move.
  std::vector<int> vertex_group;
  std::vector<int> codim_edges;   // indices into edges: those in no triangle (rods), ascending
  std::vector<int> codim_points;  // global ids of vertices in no edge (particles), ascending
};

// Returns the largest object id plus one.
inline int object_count(const CollisionMesh& mesh) {
  const auto last = std::max_element(mesh.vertex_object.begin(), mesh.vertex_object.end());
  return last == mesh.vertex_object.end() ? 0 : *last + 1;
}

}  // namespace tack
