// Displacement bounds of primitives: the largest displacement of their vertices [m].
//
// Key idea: the distance of two primitives changes by no more than the sum of both bounds.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class DisplacementBounds {
 public:
  // displacement_of(v): the length of the displacement of global vertex v [m]. The mesh must
  // outlive this object.
  template <class DisplacementOf>
  DisplacementBounds(const CollisionMesh& mesh, const DisplacementOf& displacement_of)
      : mesh_(mesh), vertices_(mesh.vertex_object.size()) {
    for_each(static_cast<int>(mesh.vertices.size()),
             [&](int i) { vertices_[mesh.vertices[i]] = displacement_of(mesh.vertices[i]); });
  }

  // Bounds of a global vertex, an edge and a triangle [m].
  double vertex(int global) const { return vertices_[global]; }
  double edge(int e) const { return largest(mesh_.edges[e]); }
  double triangle(int t) const { return largest(mesh_.triangles[t]); }

 private:
  template <std::size_t K>
  double largest(const std::array<int, K>& corners) const {
    double most = 0;
    for (const int v : corners) most = std::max(most, vertices_[v]);
    return most;
  }

  const CollisionMesh& mesh_;
  std::vector<double> vertices_;  // by global vertex
};

}  // namespace tack
