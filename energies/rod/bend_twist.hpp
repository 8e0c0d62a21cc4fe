// Bending and twisting of two edges that meet, with derivatives in closed form.
//     W = 1/2 (s - rest)^T C (s - rest),   s = (kappa_1, kappa_2, tau),
//   kappa  integrated curvature 2 tan(phi/2) of Bergou et al. 2010, phi the angle between the
//          tangents, in components along the second director and against the first
//   tau    twist angle of the second frame relative to the first frame, after the smallest rotation
//          of the first tangent to the second
//
// The rotation from frame to frame is the quaternion u + v j, with complex numbers u = w + x i,
// v = y + z i:
//     tau = 2 arg u + theta_2 - theta_1,
//     kappa_1 + i kappa_2 = -i 2 v e^(-i (theta_1 + theta_2) / 2) / |u|,
// i.e. kappa_1 = 2 z'/|u|, kappa_2 = -2 y'/|u|. These are components in the frame half-way between
// the two. They differ from those of Bergou et al., who use the mean of both frames, by the length
// cos(tau/2) of that mean: the bending energy of a section with I1 = I2 does not depend on the
// twist.
//
// Let the committed frames be those of the end of the last step, and l = (l_t, l_p, l_q) an edge in
// its committed frame. The frame of the edge is the committed frame times
// S = |l| + l_t - l_q j + l_p k, up to a factor on which nothing depends. So u and v are bilinear
// in S_1 and S_2, and S is linear except for |l|.
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
  // Committed frames of the first and of the second edge.
  BendTwist(const Quaternion& first, const Quaternion& second);

  // The edges in their committed frames and the angles; turn: arg u of the committed state, whole
  // turns included.
  struct EdgePair {
    Vec3 first, second;       // m
    double theta_1, theta_2;  // rad
    double turn;
  };
  // Returns false if a frame cannot be transported: the edge has rotated by nearly half a turn in
  // the step, or has no length.
  static bool within_reach(const Vec3& edge);

  double turn(const EdgePair& p) const;        // arg u, the value next to p.turn
  using Slopes = Eigen::Matrix<double, 3, 8>;  // by (first, second, theta_1, theta_2)
  Strains strains(const EdgePair& p, Slopes* slopes = nullptr) const;
  // Gradient and Hessian of W by (first, second, theta_1, theta_2); stiffness: C [J]. Hessian may
  // be null.
  void derivatives(const EdgePair& p, const Mat3& stiffness, const Strains& rest, Vec8& gradient,
                   Mat8* hessian) const;

 private:
  struct PairFrames;
  // (w, x, y, z)_k = S_1^T forms_[k] S_2, S = (|l| + l_t, -l_q, l_p).
  std::array<Mat3, 4> forms_;
};

}  // namespace tack
