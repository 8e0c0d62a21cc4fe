// Squared distance of each kind of stencil under one name, with the derivatives that the kernels
// have.
#pragma once

#include "framework/contact/stencils/chain_to_triangle.hpp"
#include "framework/contact/stencils/stencil_kinds.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

// Returns the interior point, then the corners of its feature.
template <int K>
std::array<Vec3, K - 2> corners(const VecX& x, const InteriorStencil<K>& s) {
  std::array<Vec3, K - 2> c;
  c[0] = point_inside(x, {s.vertices[0], s.vertices[1], s.vertices[2]}, s.inside);
  for (int i = 3; i < K; ++i) c[i - 2] = vertex(x, s.vertices[i]);
  return c;
}
template <int K>
std::array<Vec3, K> corners(const VecX& x, const ContactStencil<K>& s) {
  return corners(x, s.vertices);
}

template <class Kernels>
auto distance_between(PointPointKind, const std::array<Vec3, 2>& c) {
  return Kernels::point_point(c[0], c[1]);
}

template <class Kernels>
auto distance_between(PointEdgeKind, const std::array<Vec3, 3>& c) {
  return Kernels::point_line(c[0], c[1], c[2]);
}

template <class Kernels>
auto distance_between(PointTriangleKind, const std::array<Vec3, 4>& c) {
  return Kernels::point_plane(c[0], c[1], c[2], c[3]);
}

template <class Kernels>
auto distance_between(EdgeEdgeKind, const std::array<Vec3, 4>& c) {
  return reduce_edge_edge<Kernels>(c[0], c[1], c[2], c[3], edge_edge_type(c[0], c[1], c[2], c[3]));
}

template <class Kernels, class Kind>
auto stencil_distance(Kind, const VecX& x, const StencilOf<Kind>& s) {
  const auto c = corners(x, s);
  if constexpr (is_interior<Kind>) {
    return chain_to_triangle(distance_between<Kernels>(typename Kind::PointKind{}, c), s.inside);
  } else {
    return distance_between<Kernels>(Kind{}, c);
  }
}

}  // namespace tack
