// Inflation radii of objects [m]: the broad phase finds all pairs of surface primitives of objects
// a and b that are closer than surface[a] + surface[b], and all pairs of edges closer than edge[a]
// + edge[b].
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

struct InflationRadii {
  std::vector<double> surface, edge;  // per object [m], >= 0

  // Returns half of `range` for all objects of a mesh, and half of `edge_range` for their edges.
  static InflationRadii uniform(const CollisionMesh& mesh, double range, double edge_range) {
    const int objects = object_count(mesh);
    return {std::vector<double>(objects, 0.5 * range),
            std::vector<double>(objects, 0.5 * edge_range)};
  }

  // Returns whether no radius exceeds that of `others`.
  bool within(const InflationRadii& others) const {
    return std::ranges::equal(surface, others.surface, std::less_equal<>()) &&
           std::ranges::equal(edge, others.edge, std::less_equal<>());
  }
  // Returns the largest distance at which surfaces are found [m].
  double largest_range() const {
    return surface.empty() ? 0 : 2 * *std::ranges::max_element(surface);
  }
};

}  // namespace tack
