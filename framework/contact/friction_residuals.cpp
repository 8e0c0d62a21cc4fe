// Friction and tangential adhesion as least squares: the slip u of a contact point with energy E(y), y = |u|,
// has the two residuals R u, R = sqrt(2 E) / y. R is smooth at y = 0, where R^2 = E'/y, and
//     d(R u)/du = R across u,  E' / sqrt(2 E) = (E'/y) / R along it.
#include <cmath>

#include "framework/contact/friction_term.hpp"
#include "framework/contact/slip.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int rows = 2;

template <int K>
void contact_residuals(const Slip<K>& slip, const SlipSample& s, double* r, double* jacobian) {
  const double along_squared = slip.y > 0 ? 2 * s.value / (slip.y * slip.y) : s.slope_over_y;
  const double across = std::sqrt(std::max(along_squared, 0.0));
  Eigen::Map<Vec2>{r} = across * slip.u;
  if (!jacobian) return;
  Eigen::Matrix2d by_slip = across * Eigen::Matrix2d::Identity();
  if (slip.y > 0 && across > 0) {
    const Vec2 direction = slip.u / slip.y;
    by_slip += (s.slope_over_y / across - across) * direction * direction.transpose();
  }
  Eigen::Map<Eigen::Matrix<double, rows, 3 * K, Eigen::RowMajor>> out(jacobian);
  const Eigen::Matrix<double, 2, 3> by_point = by_slip * slip.c.tangents.transpose();
  for (int i = 0; i < K; ++i) out.template middleCols<3>(3 * i) = slip.c.coefficients[i] * by_point;
}

}  // namespace

std::vector<ResidualBatch> FrictionTerm::residual_batches() const {
  std::vector<ResidualBatch> out;
  for (const StencilBatch& b : batches()) out.push_back({b.arity, rows, b.count, b.vertices});
  return out;
}

bool FrictionTerm::residuals(const VecX& x, double* r, double* jacobian) const {
  for_each_arity(points_, [&]<int K>(const std::vector<ContactPoint<K>>& points) {
    const int count = static_cast<int>(points.size());
    for_each(count, [&](int n) {
      const Slip<K> slip(points[n], x, start_);
      const SlipSample s = slip.sample(system_.pairs().tangential(points[n].law), h_, TangentialPart::all);
      contact_residuals(slip, s, r + static_cast<size_t>(rows) * n,
                        jacobian ? jacobian + static_cast<size_t>(rows) * 3 * K * n : nullptr);
    });
    r += static_cast<size_t>(rows) * count;
    if (jacobian) jacobian += static_cast<size_t>(rows) * 3 * K * count;
  });
  return true;
}

}  // namespace tack
