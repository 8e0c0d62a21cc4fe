// The squared distance of each kind of stencil under one name; with derivatives if the kernels have them.
#pragma once

#include "framework/contact/stencil_kinds.hpp"
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

template <class Kernels>
auto stencil_distance(PointPointKind, const VecX& x, const std::array<int, 2>& v) {
  const auto c = detail::corners<2>(x, v);
  return Kernels::point_point(c[0], c[1]);
}

template <class Kernels>
auto stencil_distance(PointEdgeKind, const VecX& x, const std::array<int, 3>& v) {
  const auto c = detail::corners<3>(x, v);
  return Kernels::point_line(c[0], c[1], c[2]);
}

template <class Kernels>
auto stencil_distance(PointTriangleKind, const VecX& x, const std::array<int, 4>& v) {
  const auto c = detail::corners<4>(x, v);
  return Kernels::point_plane(c[0], c[1], c[2], c[3]);
}

template <class Kernels>
auto stencil_distance(EdgeEdgeKind, const VecX& x, const std::array<int, 4>& v) {
  const auto c = detail::corners<4>(x, v);
  return reduce_edge_edge<Kernels>(c[0], c[1], c[2], c[3], edge_edge_type(c[0], c[1], c[2], c[3]));
}

}  // namespace tack
