// Friction and tangential adhesion as least squares: the slip u of a contact point with energy E(y), y = |u|,
// has the two residuals R u, R = sqrt(2 E) / y. R is smooth at y = 0, where R^2 = E'/y, and
//     d(R u)/du = R across u,  E' / sqrt(2 E) = (E'/y) / R along it.
#include <cmath>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/terms/slip.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr int rows = 2;

// Sets the residuals of a point, and returns their derivatives by the moved point.
template <class Point>
Eigen::Matrix<double, 2, 3> residuals_of(const Slip<Point>& slip, const SlipSample& s, double* r) {
  const double along_squared = slip.y > 0 ? 2 * s.value / (slip.y * slip.y) : s.slope_over_y;
  const double across = std::sqrt(std::max(along_squared, 0.0));
  Eigen::Map<Vec2>{r} = across * slip.u;
  Eigen::Matrix2d by_slip = across * Eigen::Matrix2d::Identity();
  if (slip.y > 0 && across > 0) {
    const Vec2 direction = slip.u / slip.y;
    by_slip += (s.slope_over_y / across - across) * direction * direction.transpose();
  }
  return by_slip * slip.c.tangents.transpose();
}

}  // namespace

std::vector<ResidualBatch> FrictionTerm::residual_batches() const {
  std::vector<ResidualBatch> out;
  for (const StencilBatch& b : batches()) out.push_back({b.arity, rows, b.count, b.vertices});
  return out;
}

bool FrictionTerm::residuals(const VecX& x, double* r, double* jacobian) const {
  for_each_arity(sliding(), [&]<int K>(const std::vector<ContactPoint<K>>& points) {
    const int count = static_cast<int>(points.size());
    for_each(count, [&](int n) {
      const Slip slip(points[n], x, start_);
      const SlipSample s = slip.sample(system_.pairs().tangential(points[n].law), h_, TangentialTerm::all);
      const auto by_point = residuals_of(slip, s, r + static_cast<size_t>(rows) * n);
      if (!jacobian) return;
      Eigen::Map<Eigen::Matrix<double, rows, 3 * K, Eigen::RowMajor>> out(jacobian + static_cast<size_t>(rows) * 3 * K * n);
      for (int i = 0; i < K; ++i) out.template middleCols<3>(3 * i) = slip.c.coefficients[i] * by_point;
    });
    r += static_cast<size_t>(rows) * count;
    if (jacobian) jacobian += static_cast<size_t>(rows) * 3 * K * count;
  });
  for (const RollingGroup& group : rolling_)
    for (const RollingPoint& p : group.points) {
      const Slip slip(p, x, start_);
      const SlipSample s = slip.sample(system_.pairs().tangential(p.law), h_, TangentialTerm::all);
      const auto by_point = residuals_of(slip, s, r);
      r += rows;
      if (!jacobian) continue;
      Eigen::Map<Eigen::Matrix<double, rows, Eigen::Dynamic, Eigen::RowMajor>> out(jacobian, rows, 3 * p.arity());
      out.setZero();
      for (int i = 0; i < p.vector_count; ++i) out.middleCols<3>(3 * i) = p.coefficients[i] * by_point;
      for (int j = 0; j < p.scalar_count; ++j) out.col(3 * (p.vector_count + j)) = by_point * p.directions[j];
      jacobian += static_cast<size_t>(rows) * 3 * p.arity();
    }
  return true;
}

}  // namespace tack
