// Bending and twisting of two edges that meet, with derivatives in closed form.
//     W = 1/2 (s - rest)^T C (s - rest),   s = (kappa_1, kappa_2, tau),
// kappa: the integrated curvature 2 tan(phi/2) of Bergou et al. 2010, phi the angle between the
// tangents, in components along the second director and against the first; tau: the angle by which
// the second frame is twisted from the first, which was carried along by the smallest rotation that
// takes one tangent to the other.
//     The rotation from frame to frame is the quaternion u + v j of complex numbers u = w + x i, v
//     = y + z i, and tau = 2 arg u + theta_2 - theta_1,   kappa_1 + i kappa_2 = -i 2 v e^(-i
//     (theta_1 + theta_2) / 2) / |u|,
// i.e. kappa_1 = 2 z'/|u|, kappa_2 = -2 y'/|u|. That resolves the curvature in the frame half-way
// between the two, which differs from the mean of both that Bergou et al. take by the length
// cos(tau/2) of that mean: a section with I1 = I2 bends the same however much it is twisted.
//     With the frames committed at the end of the last step, and edges l = (l_t, l_p, l_q) in
//     components along those, the frame of
// an edge is the committed one times S = |l| + l_t - l_q j + l_p k, up to its size, on which
// nothing depends. So u and v are bilinear in S_1 and S_2, all that derivatives have to go through,
// and S is linear but for |l|.
#pragma once

#include <array>
#include <cmath>

#include "framework/rod/rod_frames.hpp"

namespace tack {

class BendTwist {
 public:
  using Vec8 = Eigen::Matrix<double, 8, 1>;
  using Mat8 = Eigen::Matrix<double, 8, 8>;
  using Strains = Vec3;  // kappa_1, kappa_2 [1], tau [rad]

  BendTwist() = default;
  // The committed frames, of which the first is to be followed by the second.
  BendTwist(const Quaternion& first, const Quaternion& second);

  // The edges in their committed frames and the angles; turn: arg u of the committed state, whole
  // turns included.
  struct EdgePair {
    Vec3 first, second;       // m
    double theta_1, theta_2;  // rad
    double turn;
  };
  // False where a frame cannot be carried along: the edge has turned by nearly half a turn since,
  // or has no length.
  static bool within_reach(const Vec3& edge);

  double turn(const EdgePair& p) const;      // arg u, the value next to p.turn
  using Slopes = Eigen::Matrix<double, 3, 8>;  // by (first, second, theta_1, theta_2)
  Strains strains(const EdgePair& p, Slopes* slopes = nullptr) const;
  // Gradient and Hessian of W by (first, second, theta_1, theta_2); stiffness: C [J]. Hessian may
  // be null.
  void derivatives(const EdgePair& p, const Mat3& stiffness, const Strains& rest, Vec8& gradient,
                   Mat8* hessian) const;

 private:
  struct Standing;
  // (w, x, y, z)_k = S_1^T forms_[k] S_2, S = (|l| + l_t, -l_q, l_p).
  std::array<Mat3, 4> forms_;
};

}  // namespace tack
