// Surface region: the triangles of one object between which and a triangle of another object the
// same laws hold. Its interface with other regions counts as an overlap boundary.
#pragma once

#include <algorithm>

#include "framework/contact/laws/pair_table.hpp"
#include "framework/contact/surface/surface_topology.hpp"

namespace tack {

class SurfaceRegion {
 public:
  // own: the triangle on the other object. object: the object of the region.
  SurfaceRegion(const PairTable& pairs, const CollisionMesh& mesh, int own, int object,
                int region_pair)
      : pairs_(pairs), mesh_(mesh), own_(mesh.triangles[own]), a_(mesh.vertex_object[own_[0]]),
        b_(object), region_pair_(region_pair) {}

  int region_pair() const { return region_pair_; }
  bool contains(int triangle) const {
    return pairs_.region_pair(a_, b_, own_, mesh_.triangles[triangle]) == region_pair_;
  }
  // Returns whether the region contains all triangles at a vertex.
  bool surrounds_vertex(const SurfaceTopology& topology, int vertex_index) const {
    const auto at = topology.triangles_at(vertex_index);
    return std::all_of(at.begin(), at.end(), [this](int t) { return contains(t); });
  }
  // Returns whether the region contains all triangles at an edge: side `side` of a triangle.
  bool surrounds_edge(const SurfaceTopology& topology, int triangle, int side) const {
    const Triangle& t = mesh_.triangles[triangle];
    const int other_end = t[(side + 1) % 3];
    const auto at = topology.triangles_at(t[side]);
    return std::all_of(at.begin(), at.end(), [&](int near) {
      const Triangle& corners = mesh_.triangles[near];
      return std::find(corners.begin(), corners.end(), other_end) == corners.end() ||
             contains(near);
    });
  }

 private:
  const PairTable& pairs_;
  const CollisionMesh& mesh_;
  const Triangle own_;
  int a_, b_, region_pair_;
};

}  // namespace tack
