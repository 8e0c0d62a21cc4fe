#include "geometry/distance/point_edge.hpp"

namespace tack {

StencilGradient<9> point_edge_gradient(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                       PointEdgeType type) {
  return reduce_point_edge<GradientKernels>(p, e0, e1, type);
}

StencilDerivatives<9> point_edge_derivatives(const Vec3& p, const Vec3& e0, const Vec3& e1,
                                             PointEdgeType type) {
  return reduce_point_edge<DerivativeKernels>(p, e0, e1, type);
}

}  // namespace tack
