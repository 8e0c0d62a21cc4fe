// Energy k/2 (l - L)^2 of two vertices at a distance l, in the slots of a stencil (Term).
#pragma once

#include <cmath>

#include "framework/core/projection.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Derivatives of the energy of a pair of points.
struct PairSpring {
  double stiffness = 0;  // k [N/m]
  double length = 0;     // L [m]

  double energy(const Vec3& span) const {
    const double stretch = span.norm() - length;
    return stiffness / 2 * stretch * stretch;
  }

  /// span: from the first vertex to the second. Writes 6 numbers of the gradient and, unless null,
  /// 27 of the Hessian.
  void derivatives(const Vec3& span, Projection projection, double* gradient,
                   double* hessian) const {
    const double l = span.norm(), force = stiffness * (l - length);
    const Vec3 n = l > 0 ? Vec3(span / l) : Vec3::Zero();
    Eigen::Map<Vec3>{gradient} = -force * n;
    Eigen::Map<Vec3>{gradient + 3} = force * n;
    if (!hessian) return;
    // The transverse stiffness of a compressed spring is negative: a projection removes it. A
    // spring of rest length 0 is isotropic, also where its ends coincide.
    const double across = l > 0 ? projected(force / l, projection) : 0.0;
    const Mat3 h =
        length == 0
            ? Mat3(stiffness * Mat3::Identity())
            : Mat3(stiffness * n * n.transpose() + across * (Mat3::Identity() - n * n.transpose()));
    Eigen::Map<Mat3>{hessian} = h;
    Eigen::Map<Mat3>{hessian + 9} = -h;
    Eigen::Map<Mat3>{hessian + 18} = h;
  }

  /// Returns the root of twice the energy, and writes its 6 derivatives unless null.
  double residual(const Vec3& span, double* jacobian) const {
    const double l = span.norm(), root = std::sqrt(stiffness);
    if (jacobian) {
      const Vec3 n = l > 0 ? Vec3(span / l) : Vec3::UnitX();
      Eigen::Map<Vec3>{jacobian} = -root * n;
      Eigen::Map<Vec3>{jacobian + 3} = root * n;
    }
    return root * (l - length);
  }
};

}  // namespace tack
