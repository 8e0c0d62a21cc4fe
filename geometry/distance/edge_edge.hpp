// Squared distance between two segments [m^2]. Stacking: (ea0, ea1, eb0, eb1). Any input is
// allowed, also parallel edges and edges of length zero. C1 in the positions except between
// parallel edges, where the closest points jump: energies multiply by the mollifier
// (edge_edge_mollifier.hpp). The Hessian jumps where the type changes. The overloads that take a
// type trust it.
#pragma once

#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/reduced_kernels.hpp"

namespace tack {

template <typename Kernels>
auto reduce_edge_edge(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                      EdgeEdgeType type) {
  using enum EdgeEdgeType;
  switch (type) {
    case EA0_EB0: return embed<4, 0, 2>(Kernels::point_point(ea0, eb0));
    case EA0_EB1: return embed<4, 0, 3>(Kernels::point_point(ea0, eb1));
    case EA1_EB0: return embed<4, 1, 2>(Kernels::point_point(ea1, eb0));
    case EA1_EB1: return embed<4, 1, 3>(Kernels::point_point(ea1, eb1));
    case EA_EB0: return embed<4, 2, 0, 1>(Kernels::point_line(eb0, ea0, ea1));
    case EA_EB1: return embed<4, 3, 0, 1>(Kernels::point_line(eb1, ea0, ea1));
    case EA0_EB: return embed<4, 0, 2, 3>(Kernels::point_line(ea0, eb0, eb1));
    case EA1_EB: return embed<4, 1, 2, 3>(Kernels::point_line(ea1, eb0, eb1));
    case EA_EB: break;
  }
  return Kernels::line_line(ea0, ea1, eb0, eb1);
}

inline double edge_edge_distance(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0, const Vec3& eb1,
                                 EdgeEdgeType type) {
  return reduce_edge_edge<ValueKernels>(ea0, ea1, eb0, eb1, type);
}
inline double edge_edge_distance(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                 const Vec3& eb1) {
  return edge_edge_distance(ea0, ea1, eb0, eb1, edge_edge_type(ea0, ea1, eb0, eb1));
}

StencilGradient<12> edge_edge_gradient(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                       const Vec3& eb1, EdgeEdgeType type);
inline StencilGradient<12> edge_edge_gradient(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                              const Vec3& eb1) {
  return edge_edge_gradient(ea0, ea1, eb0, eb1, edge_edge_type(ea0, ea1, eb0, eb1));
}

StencilDerivatives<12> edge_edge_derivatives(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                             const Vec3& eb1, EdgeEdgeType type);
inline StencilDerivatives<12> edge_edge_derivatives(const Vec3& ea0, const Vec3& ea1,
                                                    const Vec3& eb0, const Vec3& eb1) {
  return edge_edge_derivatives(ea0, ea1, eb0, eb1, edge_edge_type(ea0, ea1, eb0, eb1));
}

// The shortest vector, from edge b to edge a [m].
inline Vec3 edge_edge_separation(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                 const Vec3& eb1) {
  const EdgeEdgeType type = edge_edge_type(ea0, ea1, eb0, eb1);
  const Vec3 shortest = reduce_edge_edge<SeparationKernels>(ea0, ea1, eb0, eb1, type);
  const bool reversed = type == EdgeEdgeType::EA_EB0 || type == EdgeEdgeType::EA_EB1;
  return reversed ? Vec3(-shortest) : shortest;
}

}  // namespace tack
