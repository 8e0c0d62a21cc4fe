#include "geometry/distance/edge_edge.hpp"

namespace tack {

StencilGradient<12> edge_edge_gradient(const Vec3& ea0, const Vec3& ea1, const Vec3& eb0,
                                       const Vec3& eb1, EdgeEdgeType type) {
  return reduce_edge_edge<GradientKernels>(ea0, ea1, eb0, eb1, type);
}

StencilDerivatives<12> edge_edge_derivatives(const Vec3& ea0, const Vec3& ea1,
                                             const Vec3& eb0, const Vec3& eb1,
                                             EdgeEdgeType type) {
  return reduce_edge_edge<DerivativeKernels>(ea0, ea1, eb0, eb1, type);
}

}  // namespace tack
