// No tetrahedron may lose more than 80% of its volume in one step. Along a step the volume of a tet is
// a cubic in t; its first fall below the bound is found by subdivision with Bernstein coefficients, a
// lower bound, so the step found is never too long.
#include <Eigen/Geometry>
#include <Eigen/LU>
#include <algorithm>
#include <array>

#include "framework/core/step_filter.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double keep = 0.2;
constexpr int max_depth = 30;

using Bernstein = std::array<double, 4>;  // of a cubic on an interval

// 6 V(t) - keep 6 V(0) on [0, t_max].
Bernstein volume_margin(const Mat3& d, const Mat3& e, double t_max) {
  const auto triple = [](const Vec3& a, const Vec3& b, const Vec3& c) { return a.dot(b.cross(c)); };
  const double c0 = d.determinant(), c3 = e.determinant();
  const double c1 = triple(e.col(0), d.col(1), d.col(2)) + triple(d.col(0), e.col(1), d.col(2)) +
                    triple(d.col(0), d.col(1), e.col(2));
  const double c2 = triple(d.col(0), e.col(1), e.col(2)) + triple(e.col(0), d.col(1), e.col(2)) +
                    triple(e.col(0), e.col(1), d.col(2));
  const double a1 = c1 * t_max, a2 = c2 * t_max * t_max, a3 = c3 * t_max * t_max * t_max;
  const double b0 = (1 - keep) * c0;
  return {b0, b0 + a1 / 3, b0 + 2 * a1 / 3 + a2 / 3, b0 + a1 + a2 + a3};
}

// The end, in [0, 1], of the part from 0 on which the cubic is certainly positive.
double positive_part(const Bernstein& b, int depth) {
  if (std::min({b[0], b[1], b[2], b[3]}) > 0) return 1;
  if (!(b[0] > 0) || depth == max_depth) return 0;
  const double b01 = (b[0] + b[1]) / 2, b12 = (b[1] + b[2]) / 2, b23 = (b[2] + b[3]) / 2;
  const double b012 = (b01 + b12) / 2, b123 = (b12 + b23) / 2, middle = (b012 + b123) / 2;
  const double left = positive_part({b[0], b01, b012, middle}, depth + 1);
  if (left < 1) return left / 2;
  return 0.5 + positive_part({middle, b123, b23, b[3]}, depth + 1) / 2;
}

// The largest step up to t that one tet allows.
double bounded(const Tet& v, const VecX& x, const VecX& p, double t) {
  Mat3 d, e;
  for (int k = 0; k < 3; ++k) {
    d.col(k) = vertex(x, v[k + 1]) - vertex(x, v[0]);
    e.col(k) = vertex(p, v[k + 1]) - vertex(p, v[0]);
  }
  const Bernstein b = volume_margin(d, e, t);
  return std::min({b[0], b[1], b[2], b[3]}) > 0 ? t : t * positive_part(b, 0);
}

class Inversion : public StepFilter {
 public:
  bool attach(const FeasibilityContext& context) override {
    tets_ = &context.tets;
    clock_ = &context.clock;
    return !tets_->empty();
  }

  double largest_step(const VecX& x, const VecX& p, double t_max) override {
    const PhaseScope scope(*clock_, Phase::ccd);
    return min_chunks(static_cast<int>(tets_->size()), t_max, [&](int first, int last) {
      double t = t_max;
      for (int i = first; i < last; ++i) t = bounded((*tets_)[i], x, p, t);
      return t;
    });
  }

  std::optional<Blocker> blocker(const VecX& x, const VecX& p) override {
    std::optional<Blocker> worst;
    double t = 1;
    for (const Tet& tet : *tets_) {
      const double bound = bounded(tet, x, p, t);
      if (bound < t) worst = Blocker{{tet.begin(), tet.end()}, {}, 0, t = bound};
    }
    return worst;
  }

 private:
  const std::vector<Tet>* tets_ = nullptr;
  PhaseClock* clock_ = nullptr;
};

TACK_REGISTER(StepFilter, Inversion, "inversion", "No tetrahedron turns inside out.",
              "Smith and Schaefer 2015, Bijective Parameterization with Free Boundaries (the cubic)");

}  // namespace
}  // namespace tack
