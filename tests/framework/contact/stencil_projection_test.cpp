// The projection in five dimensions, of several stencils at a time, against that of the whole
// Hessian.
#include "framework/contact/stencils/stencil_projection.hpp"

#include <catch2/catch.hpp>

#include "tests/geometry/distance/random_stencils.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

// Random stencils with random laws of either sign, more than a pack holds and no multiple of it.
template <class Kind>
struct Batch {
  static constexpr int count = 21, n = 3 * Kind::arity, slots = 9 * hessian_blocks(Kind::arity);

  VecX x;
  StencilsOf<Kind> stencils;
  std::vector<double> gap, thresholds;
  std::vector<LawSample> law;

  // corners(i): Kind::arity columns.
  template <class Corners>
  Batch(RandomStencils& random, double threshold, const Corners& corners) : x(n * count) {
    for (int i = 0; i < count; ++i) {
      StencilOf<Kind> s{};
      const auto c = corners(i);
      for (int k = 0; k < Kind::arity; ++k) {
        s.vertices[k] = Kind::arity * i + k;
        vertex(x, s.vertices[k]) = c.col(k);
      }
      s.weight = random.uniform(-0.3, 1);
      if constexpr (is_interior<Kind>) s.inside = Vec3(0.2, 0.5, 0.3);
      stencils.push_back(s);
      gap.push_back(std::sqrt(stencil_distance<ValueKernels>(Kind{}, x, s)));
      law.push_back({random.uniform(-1, 1), random.uniform(-1e3, 1e3), random.uniform(-1e6, 1e6)});
      thresholds.push_back(threshold);
    }
  }

  // Counts the stencils whose Hessians the projection changes.
  int check(double tolerance) const {
    int changed = 0;
    for (const Projection projection : {Projection::clamp, Projection::absolute}) {
      std::vector<double> gradient(n * count), hessian(slots * count);
      projected_derivatives<Kind>(x, stencils, 0, count, thresholds.data(), gap.data(), law.data(), projection,
                                 gradient.data(), hessian.data());
      for (int i = 0; i < count; ++i) {
        typename StencilEnergy<Kind>::Vector g;
        typename StencilEnergy<Kind>::Matrix exact, fast;
        StencilEnergy<Kind>::derivatives(x, stencils[i], law[i], gap[i], thresholds[i], g, exact);
        load_blocks<Kind::arity>(hessian.data() + slots * i, fast);
        const double scale = exact.norm();
        // The Hessian of an interior point is the projected one of the point: semi-definite and an upper
        // bound, but not its own projection.
        if constexpr (is_interior<Kind>) {
          REQUIRE(smallest_eigenvalue(fast) >= -1e-12 * scale);
          REQUIRE(smallest_eigenvalue(fast - exact) >= -1e-9 * scale);
        } else {
          REQUIRE((fast - projected(exact, projection)).norm() <= tolerance * scale);
        }
        REQUIRE((Eigen::Map<const VecX>(gradient.data() + n * i, n) - g).norm() <= tolerance * g.norm());
        changed += (fast - exact).norm() > 1e-6 * scale;
      }
    }
    return changed;
  }
};

template <int K>
Eigen::Matrix<double, 3, K> points(RandomStencils& random) {
  Eigen::Matrix<double, 3, K> c;
  for (int k = 0; k < K; ++k) c.col(k) = random.vector();
  return c;
}

}  // namespace

TEST_CASE("projected stencils: points and points, lines, planes", "[contact]") {
  RandomStencils random(5);
  int changed = 0;
  for (int trial = 0; trial < 20; ++trial) {
    changed += Batch<PointPointKind>(random, 0, [&](int) { return points<2>(random); }).check(1e-13);
    changed += Batch<PointEdgeKind>(random, 0, [&](int) { return points<3>(random); }).check(1e-11);
    changed += Batch<PointTriangleKind>(random, 0, [&](int) {
                 return random.above_triangle(random.log_uniform(1e-5, 1), random.log_uniform(0.05, 1));
               }).check(1e-9);
  }
  CHECK(changed > 1000);
}

TEST_CASE("projected stencils: edges that cross, and edges whose ends are closest", "[contact]") {
  RandomStencils random(6);
  int changed = 0, ends = 0;
  for (int trial = 0; trial < 20; ++trial) {
    changed += Batch<EdgeEdgeKind>(random, 0, [&](int) {
                 return random.crossing(random.log_uniform(1e-5, 1), random.uniform(0.1, 3));
               }).check(1e-9);
    changed += Batch<EdgeEdgeKind>(random, 0, [&](int) {
                 const Stencil s = random.any();
                 ends += edge_edge_type(s.col(0), s.col(1), s.col(2), s.col(3)) != EdgeEdgeType::EA_EB;
                 return s;
               }).check(1e-9);
  }
  CHECK(changed > 1000);
  CHECK(ends > 100);
}

TEST_CASE("projected stencils: mollified edges among others", "[contact]") {
  RandomStencils random(7);
  const auto corners = [&](int i) { return random.crossing(0.01, i % 3 == 0 ? 0.01 : 1.0); };
  CHECK(Batch<EdgeEdgeKind>(random, 0.1, corners).check(1e-9) > 10);
}

TEST_CASE("projected stencils: interior points", "[contact]") {
  RandomStencils random(8);
  CHECK(Batch<InteriorKind<PointPointKind>>(random, 0, [&](int) { return points<4>(random); }).check(1e-9) > 5);
  CHECK(Batch<InteriorKind<PointEdgeKind>>(random, 0, [&](int) { return points<5>(random); }).check(1e-9) > 5);
  CHECK(Batch<InteriorKind<PointTriangleKind>>(random, 0, [&](int) { return points<6>(random); }).check(1e-9) > 5);
}

TEST_CASE("projected stencils: tiny gaps and slivers stay semi-definite and free of translations", "[contact]") {
  RandomStencils random(9);
  constexpr int slots = Batch<PointTriangleKind>::slots;
  for (int trial = 0; trial < 20; ++trial) {
    const Batch<PointTriangleKind> b(random, 0, [&](int) {
      return random.above_triangle(random.log_uniform(1e-12, 1e-6), random.log_uniform(1e-5, 1));
    });
    std::vector<double> gradient(12 * b.count), hessian(slots * b.count);
    projected_derivatives<PointTriangleKind>(b.x, b.stencils, 0, b.count, nullptr, b.gap.data(), b.law.data(),
                                            Projection::clamp, gradient.data(), hessian.data());
    for (int i = 0; i < b.count; ++i) {
      Mat12 h;
      load_blocks<4>(hessian.data() + slots * i, h);
      REQUIRE(h.allFinite());
      REQUIRE(smallest_eigenvalue(h) >= -1e-12 * h.norm());
      Eigen::Matrix<double, 12, 3> translations;
      for (int v = 0; v < 4; ++v) translations.middleRows<3>(3 * v).setIdentity();
      REQUIRE((h * translations).norm() <= 1e-10 * h.norm());
    }
  }
}
