// Continuous collision detection as a step filter: no pair of primitives may lose more than 90% of
// its gap on the way. Pairs whose boxes are further apart than their motion can bridge are skipped;
// the others are handed to additive CCD.
#include <algorithm>

#include "framework/assembly/parallel.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/core/step_filter.hpp"
#include "geometry/ccd/accd.hpp"

namespace tack {
namespace {

constexpr double keep = 0.1;  // fraction of each gap that must remain

// Lower bound of the squared distance of two primitives: the gap between their boxes.
template <size_t A, size_t B>
double box_gap_squared(const std::array<Vec3, A>& a, const std::array<Vec3, B>& b) {
  Vec3 low_a = a[0], high_a = a[0], low_b = b[0], high_b = b[0];
  for (size_t i = 1; i < A; ++i) low_a = low_a.cwiseMin(a[i]), high_a = high_a.cwiseMax(a[i]);
  for (size_t i = 1; i < B; ++i) low_b = low_b.cwiseMin(b[i]), high_b = high_b.cwiseMax(b[i]);
  return (low_b - high_a).cwiseMax(low_a - high_b).cwiseMax(0.0).squaredNorm();
}

// Largest motion of a vertex of one relative to the other's, bounded through the mean of all.
template <size_t A, size_t B>
double approach(const std::array<Vec3, A>& da, const std::array<Vec3, B>& db) {
  Vec3 mean = Vec3::Zero();
  for (const Vec3& d : da) mean += d;
  for (const Vec3& d : db) mean += d;
  mean /= static_cast<double>(A + B);
  double a = 0, b = 0;
  for (const Vec3& d : da) a = std::max(a, (d - mean).squaredNorm());
  for (const Vec3& d : db) b = std::max(b, (d - mean).squaredNorm());
  return std::sqrt(a) + std::sqrt(b);
}

template <size_t N>
std::array<Vec3, N> at(const VecX& x, const std::array<int, N>& v) {
  std::array<Vec3, N> c;
  for (size_t i = 0; i < N; ++i) c[i] = vertex(x, v[i]);
  return c;
}

class Ccd : public StepFilter {
 public:
  bool attach(const FeasibilityContext& context) override {
    contact_ = context.contact;
    clock_ = &context.clock;
    return contact_ != nullptr;
  }

  double largest_step(const VecX& x, const VecX& p, double t_max) override {
    contact_->cover(x, t_max * p);
    const PhaseScope scope(*clock_, Phase::ccd);
    const Candidates& c = contact_->candidates();
    const CollisionMesh& mesh = contact_->surface().mesh;
    const auto point = [](int v) { return std::array{v}; };
    double t = t_max;
    t = over(c.edge_edge, x, p, t,
             [&](const auto& pair) { return std::pair{mesh.edges[pair[0]], mesh.edges[pair[1]]}; },
             [](const auto& a, const auto& b, const auto& da, const auto& db, double limit) {
               return edge_edge_accd(a[0], a[1], b[0], b[1], da[0], da[1], db[0], db[1], keep, limit);
             });
    t = over(c.point_triangle, x, p, t,
             [&](const auto& pair) { return std::pair{point(pair[0]), mesh.triangles[pair[1]]}; },
             [](const auto& a, const auto& b, const auto& da, const auto& db, double limit) {
               return point_triangle_accd(a[0], b[0], b[1], b[2], da[0], db[0], db[1], db[2], keep, limit);
             });
    t = over(c.point_edge, x, p, t,
             [&](const auto& pair) { return std::pair{point(pair[0]), mesh.edges[pair[1]]}; },
             [](const auto& a, const auto& b, const auto& da, const auto& db, double limit) {
               return point_edge_accd(a[0], b[0], b[1], da[0], db[0], db[1], keep, limit);
             });
    return over(c.point_point, x, p, t,
                [&](const auto& pair) { return std::pair{point(pair[0]), point(pair[1])}; },
                [](const auto& a, const auto& b, const auto& da, const auto& db, double limit) {
                  return point_point_accd(a[0], b[0], da[0], db[0], keep, limit);
                });
  }

 private:
  template <class Primitives, class Accd>
  double over(const std::vector<std::array<int, 2>>& pairs, const VecX& x, const VecX& p, double t_max,
              const Primitives& primitives, const Accd& accd) const {
    return min_chunks(static_cast<int>(pairs.size()), t_max, [&](int first, int last) {
      double t = t_max;
      for (int i = first; i < last; ++i) {
        const auto [va, vb] = primitives(pairs[i]);
        const auto a = at(x, va);
        const auto b = at(x, vb);
        const auto da = at(p, va);
        const auto db = at(p, vb);
        const double motion = t * approach(da, db) / (1 - keep);
        if (motion * motion < box_gap_squared(a, b)) continue;
        t = std::min(t, accd(a, b, da, db, t));
      }
      return t;
    });
  }

  ContactSystem* contact_ = nullptr;
  PhaseClock* clock_ = nullptr;
};

TACK_REGISTER(StepFilter, Ccd, "ccd", "Nothing that moves passes through anything.",
              "Li et al. 2021, Codimensional Incremental Potential Contact (additive CCD)");

}  // namespace
}  // namespace tack
