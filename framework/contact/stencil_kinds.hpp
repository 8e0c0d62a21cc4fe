// The four kinds of contact stencils under one interface: squared distance with derivatives, and the
// number of leading vertices that belong to the first of the two primitives.
#pragma once

#include "framework/contact/contact_set.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

namespace detail {
template <int K>
std::array<Vec3, K> corners(const VecX& x, const std::array<int, K>& v) {
  std::array<Vec3, K> c;
  for (int i = 0; i < K; ++i) c[i] = vertex(x, v[i]);
  return c;
}
}  // namespace detail

struct PointPointKind {
  static constexpr int arity = 2, first_vertices = 1;
  template <class Kernels>
  static auto distance(const VecX& x, const std::array<int, 2>& v) {
    const auto c = detail::corners<2>(x, v);
    return Kernels::point_point(c[0], c[1]);
  }
};

struct PointEdgeKind {
  static constexpr int arity = 3, first_vertices = 1;
  template <class Kernels>
  static auto distance(const VecX& x, const std::array<int, 3>& v) {
    const auto c = detail::corners<3>(x, v);
    return Kernels::point_line(c[0], c[1], c[2]);
  }
};

struct PointTriangleKind {
  static constexpr int arity = 4, first_vertices = 1;
  template <class Kernels>
  static auto distance(const VecX& x, const std::array<int, 4>& v) {
    const auto c = detail::corners<4>(x, v);
    return Kernels::point_plane(c[0], c[1], c[2], c[3]);
  }
};

struct EdgeEdgeKind {
  static constexpr int arity = 4, first_vertices = 2;
  template <class Kernels>
  static auto distance(const VecX& x, const std::array<int, 4>& v) {
    const auto c = detail::corners<4>(x, v);
    return reduce_edge_edge<Kernels>(c[0], c[1], c[2], c[3], edge_edge_type(c[0], c[1], c[2], c[3]));
  }
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
