// Orthogonal projection onto the span of one or two vectors: the parameters that minimise
// |offset + u a| or |offset + u a + v b|, and the shortest vector ("residual") that is left.
//
// Every distance in this folder starts here. Each projection runs twice: the first residual carries
// a rounding error of eps |offset| along the span, which would tilt its direction badly when the
// gap is 1e-9 of the feature's size; projecting the (short) residual once more removes it. It also
// makes the residual of nearly parallel a and b accurate to eps / sin(angle) relative to its own
// length.
#pragma once

#include <Eigen/Geometry>

#include "geometry/distance/stencil_derivatives.hpp"
#include "geometry/types.hpp"

namespace tack {

struct LineProjection {
  double u;       // parameter of the closest point of the line
  Vec3 residual;  // offset + u a, orthogonal to a [m]
};

// Needs |a| > 0.
inline LineProjection project_onto_line(const Vec3& offset, const Vec3& a) {
  const double inverse = 1.0 / a.squaredNorm();
  const double u = -inverse * a.dot(offset);
  const Vec3 first = offset + u * a;
  const double du = -inverse * a.dot(first);
  return {u + du, first + du * a};
}

struct PlaneProjection {
  double u, v;          // parameters of the closest point
  Vec3 residual;        // offset + u a + v b, orthogonal to a and b [m]
  Vec3 normal;          // a x b, not normalised [m^2]
  double inverse;       // 1 / |normal|^2 [m^-4]
  Vec3 dual_a, dual_b;  // in the plane, dual_a . a = 1, dual_a . b = 0 and so on [1/m]
};

// Needs a and b linearly independent; see nearly_parallel.
inline PlaneProjection project_onto_plane(const Vec3& offset, const Vec3& a, const Vec3& b) {
  const Vec3 normal = a.cross(b);
  const double inverse = 1.0 / normal.squaredNorm();
  const Vec3 dual_a = inverse * b.cross(normal);
  const Vec3 dual_b = inverse * normal.cross(a);
  const double u = -dual_a.dot(offset);
  const double v = -dual_b.dot(offset);
  const Vec3 first = offset + u * a + v * b;
  const double du = -dual_a.dot(first);
  const double dv = -dual_b.dot(first);
  return {u + du, v + dv, first + du * a + dv * b, normal, inverse, dual_a, dual_b};
}

// True for sin^2(angle between a and b) <= 1e-20, and for vectors of length zero. Beyond that the
// cross product is rounding noise, and treating the span as a line moves a distance by 1e-10 |a| at
// most.
inline bool nearly_parallel(const Vec3& a, const Vec3& b) {
  return a.cross(b).squaredNorm() <= 1e-20 * a.squaredNorm() * b.squaredNorm();
}

// Hessian of s = |r|^2 for r = sum_i w_i x_i, the residual of a projection onto a plane whose
// parameters follow the four vertices.
//   w       weights of the vertices in r
//   duals   q_i = sum_u (dw_i/du) dual_u, one column a vertex
// With r = h n (n unit), differentiating ds/dx_i = 2 w_i h n with dn/dx_j = -q_j n^T gives
//   1/2 d2s/dx_i dx_j = (w_i w_j - s q_i.q_j) n n^T - h (w_i q_j n^T + w_j n q_i^T).
Mat12 plane_hessian(const Eigen::Vector4d& w, const Eigen::Matrix<double, 3, 4>& duals,
                    const PlaneProjection& plane);

}  // namespace tack
