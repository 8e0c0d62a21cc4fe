// The four kinds of contact stencils: their vertices, and how many of them lead that belong to the first of
// the two primitives. Distances: stencil_distance.hpp.
#pragma once

#include "framework/contact/contact_set.hpp"

namespace tack {

struct PointPointKind {
  static constexpr int arity = 2, first_vertices = 1;
};

struct PointEdgeKind {
  static constexpr int arity = 3, first_vertices = 1;
};

struct PointTriangleKind {
  static constexpr int arity = 4, first_vertices = 1;
};

struct EdgeEdgeKind {
  static constexpr int arity = 4, first_vertices = 2;
};

// Calls body(Kind, stencils, thresholds or null) for each kind, in batch order.
template <class Body>
void for_each_kind(const ContactSet& set, const Body& body) {
  body(PointPointKind{}, set.point_point, nullptr);
  body(PointEdgeKind{}, set.point_edge, nullptr);
  body(PointTriangleKind{}, set.point_triangle, nullptr);
  body(EdgeEdgeKind{}, set.edge_edge, set.mollifier_threshold.data());
}

}  // namespace tack
