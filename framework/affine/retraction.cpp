#include "framework/affine/retraction.hpp"

#include <Eigen/LU>

#include "geometry/cross_matrix.hpp"

namespace tack {
namespace {

// Returns the polar factor of a matrix with a positive determinant, by Newton's iteration with
// Higham's scaling (Higham 1986, Computing the Polar Decomposition, with Applications).
Mat3 rotation_of(const Mat3& m) {
  constexpr int max_iterations = 30;
  Mat3 r = m;
  for (int i = 0; i < max_iterations; ++i) {
    const Mat3 inverse = r.inverse(), before = r;
    const double scale = std::sqrt(inverse.norm() / r.norm());
    r = scale / 2 * r + 1 / (2 * scale) * inverse.transpose();
    if ((r - before).norm() < 1e-9 * r.norm()) break;  // the remaining error is the square of this
  }
  return r;
}

}  // namespace

bool retract_change(const Mat3& a, Mat3& change) {
  const Mat3 end = a + change;
  if (!(end.determinant() > 0)) return false;
  const Mat3 r = rotation_of(a), s = r.transpose() * a, k = r.transpose() * change;
  // The skew part of K = W S + D is that of W S, which is (tr S - S) w.
  const Vec3 twice(k(2, 1) - k(1, 2), k(0, 2) - k(2, 0), k(1, 0) - k(0, 1));
  const Vec3 w = (s.trace() * Mat3::Identity() - s).inverse() * twice;
  change = rotation_of(end) * (s + k - cross_matrix(w) * s) - a;
  return true;
}

}  // namespace tack
