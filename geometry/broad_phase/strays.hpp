// How far primitives have moved, each as far as the farthest of its vertices: the distance of two of them changes by no
// more than the sum of both.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

// Of every primitive of a mesh [m].
struct Strays {
  std::vector<double> vertices;  // by global vertex
  std::vector<double> edges, triangles;
};

// of_vertex(v): how far global vertex v moves [m].
template <class OfVertex>
Strays find_strays(const CollisionMesh& mesh, const OfVertex& of_vertex) {
  Strays strays;
  strays.vertices.resize(mesh.vertex_object.size());
  for (const int v : mesh.vertices) strays.vertices[v] = of_vertex(v);
  const auto spread = [&](const auto& primitives, std::vector<double>& farthest) {
    farthest.reserve(primitives.size());
    for (const auto& corners : primitives) {
      double most = 0;
      for (const int v : corners) most = std::max(most, strays.vertices[v]);
      farthest.push_back(most);
    }
  };
  spread(mesh.edges, strays.edges);
  spread(mesh.triangles, strays.triangles);
  return strays;
}

}  // namespace tack
