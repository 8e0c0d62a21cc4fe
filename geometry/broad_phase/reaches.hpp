// How far around each object the broad phase looks: surfaces of objects a and b are wanted where they are closer than surface[a] + surface[b], edges
// where they are closer than edge[a] + edge[b].
#pragma once

#include <algorithm>
#include <functional>
#include <vector>

#include "geometry/mesh/collision_mesh.hpp"

namespace tack {

struct Reaches {
  std::vector<double> surface, edge;  // per object [m], >= 0

  // The same for all objects of a mesh: within `range`, and of edges within `edge_range`.
  static Reaches uniform(const CollisionMesh& mesh, double range, double edge_range) {
    const int objects = object_count(mesh);
    return {std::vector<double>(objects, 0.5 * range), std::vector<double>(objects, 0.5 * edge_range)};
  }

  // Whether others look as far for every object.
  bool within(const Reaches& others) const {
    return std::ranges::equal(surface, others.surface, std::less_equal<>()) && std::ranges::equal(edge, others.edge, std::less_equal<>());
  }
  double largest_range() const { return surface.empty() ? 0 : 2 * *std::ranges::max_element(surface); }
};

}  // namespace tack
