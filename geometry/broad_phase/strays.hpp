// How far primitives have moved, each as far as the farthest of its vertices: the distance of two of them changes by no
// more than the sum of both.
#pragma once

#include <algorithm>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"
#include "geometry/parallel.hpp"

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
  for_each(static_cast<int>(mesh.vertices.size()), [&](int i) { strays.vertices[mesh.vertices[i]] = of_vertex(mesh.vertices[i]); });
  const auto spread = [&](const auto& primitives, std::vector<double>& farthest) {
    farthest.resize(primitives.size());
    for_each(static_cast<int>(primitives.size()), [&](int i) {
      double most = 0;
      for (const int v : primitives[i]) most = std::max(most, strays.vertices[v]);
      farthest[i] = most;
    });
  };
  spread(mesh.edges, strays.edges);
  spread(mesh.triangles, strays.triangles);
  return strays;
}

}  // namespace tack
