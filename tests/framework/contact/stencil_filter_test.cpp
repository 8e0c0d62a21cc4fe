// The projection in five dimensions against that of the whole 12x12 Hessian.
#include "framework/contact/stencil_filter.hpp"

#include <catch2/catch.hpp>

#include "tests/geometry/distance/random_stencils.hpp"
#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

VecX configuration(const Stencil& s) { return Eigen::Map<const VecX>(s.data(), 12); }

// The Hessian of a stencil at a law of the given slope and curvature, and both projections of it.
template <class Kind>
struct Filtered {
  Mat12 exact, fast;
  MatX whole;

  Filtered(const Stencil& s, const LawSample& law, SpdFilter filter) {
    const VecX x = configuration(s);
    ContactStencil<4> stencil{};
    stencil.vertices = {0, 1, 2, 3};
    stencil.weight = 0.7;
    Vec12 gradient;
    const double gap = std::sqrt(stencil_distance<DerivativeKernels>(Kind{}, x, stencil).value);
    StencilEnergy<Kind>::derivatives(x, stencil, law, gap, 0, gradient, exact);
    fast = exact;
    filter_hessian<Kind>(x, stencil, 0, fast, filter);
    whole = projected(exact, filter);
  }
};

// Counts how often the filter had to do something.
template <class Kind>
int compare(const Stencil& s, RandomStencils& random) {
  int changed = 0;
  for (int trial = 0; trial < 4; ++trial) {
    const LawSample law{random.uniform(-1, 1), random.uniform(-1e3, 1e3), random.uniform(-1e6, 1e6)};
    for (const SpdFilter filter : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) {
      const Filtered<Kind> f(s, law, filter);
      const double scale = f.exact.norm();
      INFO("slope " << law.slope << ", curvature " << law.curvature);
      REQUIRE((f.fast - f.whole).norm() <= 1e-9 * scale);
      if (filter == SpdFilter::none) REQUIRE(f.fast == f.exact);
      changed += (f.fast - f.exact).norm() > 1e-6 * scale;
    }
  }
  return changed;
}

template <class Kind, class Draw>
void compare_many(unsigned seed, const Draw& draw) {
  RandomStencils random(seed);
  int changed = 0;
  for (int i = 0; i < 200; ++i) changed += compare<Kind>(draw(random), random);
  CHECK(changed > 200);
}

}  // namespace

TEST_CASE("points above triangles: five dimensions give the projection of twelve", "[contact]") {
  compare_many<PointTriangleKind>(5, [](RandomStencils& random) {
    return random.above_triangle(random.log_uniform(1e-5, 1), random.log_uniform(0.05, 1));
  });
}

TEST_CASE("crossing edges: five dimensions give the projection of twelve", "[contact]") {
  compare_many<EdgeEdgeKind>(6, [](RandomStencils& random) {
    return random.crossing(random.log_uniform(1e-5, 1), random.uniform(0.1, 3));
  });
}

TEST_CASE("the basis of a distance's Hessian is orthonormal and holds no translation", "[contact]") {
  RandomStencils random(7);
  for (int i = 0; i < 100; ++i) {
    Eigen::Vector4d c(1, random.uniform(-1, 0), random.uniform(-1, 0), 0);
    c(3) = -c.sum();
    const DistanceBasis basis = distance_basis(c, random.vector().normalized());
    CHECK((basis.transpose() * basis - Eigen::Matrix<double, 5, 5>::Identity()).norm() < 1e-12);
    for (int k = 0; k < 3; ++k) {
      Vec12 translation = Vec12::Zero();
      for (int v = 0; v < 4; ++v) translation(3 * v + k) = 1;
      CHECK((basis.transpose() * translation).norm() < 1e-12);
    }
  }
}
