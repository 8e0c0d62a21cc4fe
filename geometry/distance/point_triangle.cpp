#include "geometry/distance/point_triangle.hpp"

namespace tack {

StencilGradient<12> point_triangle_gradient(const Vec3& p, const Vec3& t0, const Vec3& t1,
                                            const Vec3& t2, PointTriangleType type) {
  return reduce_point_triangle<GradientKernels>(p, t0, t1, t2, type);
}

StencilDerivatives<12> point_triangle_derivatives(const Vec3& p, const Vec3& t0,
                                                  const Vec3& t1, const Vec3& t2,
                                                  PointTriangleType type) {
  return reduce_point_triangle<DerivativeKernels>(p, t0, t1, t2, type);
}

}  // namespace tack
