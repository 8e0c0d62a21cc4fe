// Surface region: the triangles of one object between which and a triangle of another object the
// same laws hold. Its interface with other regions counts as an overlap boundary.
#pragma once

#include <algorithm>

#include "framework/contact/pair_table.hpp"
#include "framework/contact/surface_topology.hpp"

namespace tack {

class SurfaceRegion {
 public:
  // own: the triangle on the other object; object: the object of the region.
  SurfaceRegion(const PairTable& pairs, const CollisionMesh& mesh, int own, int object, int part)
      : pairs_(pairs),
        mesh_(mesh),
        own_(mesh.triangles[own]),
        a_(mesh.vertex_object[own_[0]]),
        b_(object),
        part_(part) {}

  int part() const { return part_; }
  bool has(int triangle) const {
    return pairs_.part(a_, b_, own_, mesh_.triangles[triangle]) == part_;
  }
  // Returns whether the region holds all triangles around a vertex, and around side i of a
  // triangle.
  bool around(const SurfaceTopology& topology, int vertex_index) const {
    const auto at = topology.triangles_at(vertex_index);
    return std::all_of(at.begin(), at.end(), [this](int t) { return has(t); });
  }
  bool beyond(const SurfaceTopology& topology, int triangle, int i) const {
    const Triangle& t = mesh_.triangles[triangle];
    const int other_end = t[(i + 1) % 3];
    const auto at = topology.triangles_at(t[i]);
    return std::all_of(at.begin(), at.end(), [&](int near) {
      const Triangle& corners = mesh_.triangles[near];
      return std::find(corners.begin(), corners.end(), other_end) == corners.end() || has(near);
    });
  }

 private:
  const PairTable& pairs_;
  const CollisionMesh& mesh_;
  const Triangle own_;
  int a_, b_, part_;
};

}  // namespace tack
