// Kinds of contact stencils: the number of their vertices, and how many leading vertices belong to
// the first of the two primitives. Distances: stencil_distance.hpp.
#pragma once

#include "framework/contact/stencils/contact_set.hpp"

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

// The point is an interior quadrature point.
template <class Point>
struct InteriorKind {
  using PointKind = Point;
  static constexpr int arity = Point::arity + 2, first_vertices = 3;
};

template <class Kind>
inline constexpr bool is_interior = false;
template <class Point>
inline constexpr bool is_interior<InteriorKind<Point>> = true;

// Kind of a stencil with interior points replaced by vertices.
template <class Kind>
struct PointKindOf {
  using type = Kind;
};
template <class Point>
struct PointKindOf<InteriorKind<Point>> {
  using type = Point;
};

template <class Kind>
using StencilOf = std::conditional_t<is_interior<Kind>, InteriorStencil<Kind::arity>,
                                     ContactStencil<Kind::arity>>;
template <class Kind>
using StencilsOf = std::vector<StencilOf<Kind>>;
inline constexpr int stencil_kind_count = 7;

// Calls body(Kind, stencils, thresholds or null) for each kind, in batch order.
template <class Body>
void for_each_kind(const ContactSet& set, const Body& body) {
  body(PointPointKind{}, set.point_point, nullptr);
  body(PointEdgeKind{}, set.point_edge, nullptr);
  body(PointTriangleKind{}, set.point_triangle, nullptr);
  body(EdgeEdgeKind{}, set.edge_edge, set.mollifier_threshold.data());
  body(InteriorKind<PointPointKind>{}, set.interior_point, nullptr);
  body(InteriorKind<PointEdgeKind>{}, set.interior_edge, nullptr);
  body(InteriorKind<PointTriangleKind>{}, set.interior_triangle, nullptr);
}

}  // namespace tack
