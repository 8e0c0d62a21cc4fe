// The kinds of contact stencils: their vertices, and how many of them lead that belong to the first
// of the two primitives. Distances: stencil_distance.hpp.
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

// The point is one inside a triangle.
template <class Point>
struct SampleKind {
  using PointKind = Point;
  static constexpr int arity = Point::arity + 2, first_vertices = 3;
};

template <class Kind>
inline constexpr bool is_sample = false;
template <class Point>
inline constexpr bool is_sample<SampleKind<Point>> = true;

// Kind of a stencil with the points inside triangles replaced by vertices.
template <class Kind>
struct PointKindOf {
  using type = Kind;
};
template <class Point>
struct PointKindOf<SampleKind<Point>> {
  using type = Point;
};

template <class Kind>
using StencilOf =
    std::conditional_t<is_sample<Kind>, SampleStencil<Kind::arity>, ContactStencil<Kind::arity>>;
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
  body(SampleKind<PointPointKind>{}, set.sample_point, nullptr);
  body(SampleKind<PointEdgeKind>{}, set.sample_edge, nullptr);
  body(SampleKind<PointTriangleKind>{}, set.sample_triangle, nullptr);
}

}  // namespace tack
