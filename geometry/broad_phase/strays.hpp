// How far primitives have moved, each as far as the farthest of its vertices: the distance of two of them changes by no
// more than the sum of both.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class Strays {
 public:
  // of_vertex(v): how far global vertex v moves [m]. The mesh must outlive this.
  template <class OfVertex>
  Strays(const CollisionMesh& mesh, const OfVertex& of_vertex) : mesh_(mesh), vertices_(mesh.vertex_object.size()) {
    for_each(static_cast<int>(mesh.vertices.size()), [&](int i) { vertices_[mesh.vertices[i]] = of_vertex(mesh.vertices[i]); });
  }

  // [m]
  double vertex(int global) const { return vertices_[global]; }
  double edge(int e) const { return farthest(mesh_.edges[e]); }
  double triangle(int t) const { return farthest(mesh_.triangles[t]); }

 private:
  template <std::size_t K>
  double farthest(const std::array<int, K>& corners) const {
    double most = 0;
    for (const int v : corners) most = std::max(most, vertices_[v]);
    return most;
  }

  const CollisionMesh& mesh_;
  std::vector<double> vertices_;  // by global vertex
};

}  // namespace tack
