// Close pairs of primitives as data, for minimisers that build a model of contact of their own.
#pragma once

#include <array>
#include <span>

#include "framework/core/step_cuts.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Two primitives that are close to each other: their vertices and closest points.
struct ClosePair {
  CutKind kind = CutKind::other;    // edge_edge, point_triangle, point_edge or point_point
  std::array<int, 4> vertices{};    // global: of the first primitive, then of the second
  std::array<double, 4> weights{};  // of the vertices in the closest points: 1 in all, each
  int first_count = 0;              // vertices of the first primitive
  int count = 0;                    // vertices
  double distance = 0, offset = 0;  // between the closest points; of the contact surfaces [m]
  Vec3 normal = Vec3::Zero();       // unit vector from the second closest point to the first; zero
                                    // where the distance is
  std::array<int, 2> bodies{-1, -1};

  std::span<const int> all_vertices() const {
    return {vertices.data(), static_cast<std::size_t>(count)};
  }
  /// Returns the gap between the contact surfaces [m].
  double gap() const { return distance - offset; }
  friend bool operator<(const ClosePair& a, const ClosePair& b) {
    return a.kind != b.kind ? a.kind < b.kind : a.vertices < b.vertices;
  }
};

}  // namespace tack
