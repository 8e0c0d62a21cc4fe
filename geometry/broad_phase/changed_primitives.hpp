// Flags of the objects whose boxes have changed, and of their vertices, edges and triangles.
#pragma once

#include <vector>

#include "geometry/mesh/collision_mesh.hpp"
#include "geometry/parallel.hpp"

namespace tack {

struct ChangedPrimitives {
  std::vector<char> objects;
  std::vector<char> vertices;  // by global vertex
  std::vector<char> edges, triangles;

  // which: a flag per object.
  void mark(const CollisionMesh& mesh, const std::vector<char>& which) {
    objects = which;
    const auto mark_all = [&](std::vector<char>& flags, size_t n, const auto& vertex_of) {
      flags.resize(n);
      for_each(
          static_cast<int>(n), [&](int i) { flags[i] = objects[mesh.vertex_object[vertex_of(i)]]; },
          2048);
    };
    mark_all(vertices, mesh.vertex_object.size(), [](int v) { return v; });
    mark_all(edges, mesh.edges.size(), [&](int e) { return mesh.edges[e][0]; });
    mark_all(triangles, mesh.triangles.size(), [&](int t) { return mesh.triangles[t][0]; });
  }
};

}  // namespace tack
