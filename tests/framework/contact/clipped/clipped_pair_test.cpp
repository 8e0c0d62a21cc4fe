// The clipped integral of two triangles, against closed forms and finite differences.
#include "framework/contact/clipped/clipped_pair.hpp"

#include <catch2/catch.hpp>
#include <Eigen/Geometry>
#include <Eigen/Eigenvalues>
#include <random>

#include "framework/assembly/stencil_blocks.hpp"
#include "framework/contact/clipped/boundary_weight.hpp"
#include "framework/contact/clipped/clip_pack.hpp"
#include "tests/framework/contact/clipped/clipped_plates.hpp"

namespace tack {
namespace {

std::array<Vec3, 6> corners_of(const ClippedPair& pair) {
  return {pair.a[0], pair.a[1], pair.a[2], pair.b[0], pair.b[1], pair.b[2]};
}
void set_corners(ClippedPair& pair, const std::array<Vec3, 6>& x) {
  for (int k = 0; k < 3; ++k) {
    pair.a[k] = x[k];
    pair.b[k] = x[3 + k];
  }
}

double energy_at(ClipIntegrator& integrator, ClippedPair pair, const std::array<Vec3, 6>& x, const PairLaw& law,
                 const GapBands& bands) {
  set_corners(pair, x);
  return integrator.value(pair, law, bands).energy;
}

// A triangle b in the plane z = 0 seen from above, and a above it, facing down, both with noise.
ClippedPair random_pair(std::mt19937& random, double tilt) {
  std::uniform_real_distribution<double> u(-1, 1);
  ClippedPair pair;
  pair.b = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.5, 1.8, 0)};
  pair.a = {Vec3(0.2, 0.1, 0.4), Vec3(0.4, 1.6, 0.4), Vec3(1.9, 0.3, 0.4)};
  const Vec3 shift(u(random), u(random), 0.3 * u(random));
  for (int k = 0; k < 3; ++k) {
    pair.a[k] += shift + Vec3(0.3 * u(random), 0.3 * u(random), tilt * u(random));
    pair.b[k] += Vec3(0.2 * u(random), 0.2 * u(random), 0.5 * tilt * u(random));
  }
  return pair;
}

TEST_CASE("the gradient of a clipped pair is that of its energy", "[clipped]") {
  std::mt19937 random(7);
  ClipIntegrator integrator;
  const PairLaw tent = tent_law(), steep = steep_law();
  int compared = 0;
  for (int trial = 0; trial < 400; ++trial) {
    ClippedPair pair = random_pair(random, trial % 4 == 0 ? 1.5 : 0.2);
    if (trial % 2) pair.strip_b = {0.25, 0, trial % 3 ? 0.25 : 0};
    Vec18 gradient;
    const PairLaw& law = trial % 3 == 2 ? steep : tent;
    const GapBands bands = gap_bands(law);
    if (integrator.derivatives(pair, law, bands, gradient, nullptr).energy == 0) continue;
    ++compared;
    std::array<Vec3, 6> x = corners_of(pair);
    for (int i = 0; i < 18; ++i) {
      // Fourth-order differences.
      constexpr double h = 1e-5;
      const auto at = [&](double step) {
        std::array<Vec3, 6> moved = x;
        moved[i / 3][i % 3] += step;
        return energy_at(integrator, pair, moved, law, bands);
      };
      const double difference = (8 * (at(h) - at(-h)) - (at(2 * h) - at(-2 * h))) / (12 * h);
      INFO("trial " << trial << ", variable " << i);
      CHECK(gradient[i] == Approx(difference).margin(2e-7));
    }
  }
  CHECK(compared > 200);
}

TEST_CASE("a clipped pair has no net force and no net moment", "[clipped]") {
  std::mt19937 random(8);
  ClipIntegrator integrator;
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  for (int trial = 0; trial < 200; ++trial) {
    ClippedPair pair = random_pair(random, 0.5);
    pair.strip_b = {0.25, 0.25, 0};
    Vec18 gradient;
    integrator.derivatives(pair, law, bands, gradient, nullptr);
    const std::array<Vec3, 6> x = corners_of(pair);
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (int k = 0; k < 6; ++k) {
      force += gradient.segment<3>(3 * k);
      moment += x[k].cross(gradient.segment<3>(3 * k));
    }
    CHECK(force.norm() < 1e-12);
    CHECK(moment.norm() < 1e-11);
  }
}

TEST_CASE("the Hessian of a clipped pair is symmetric and positive semi-definite", "[clipped]") {
  std::mt19937 random(9);
  ClipIntegrator integrator;
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  double largest = 0;
  for (int trial = 0; trial < 100; ++trial) {
    ClippedPair pair = random_pair(random, 0.3);
    pair.strip_b = {0.25, 0.25, 0.25};
    pair.boundary_a = {true, true, false};
    Vec18 gradient;
    Mat18 hessian;
    integrator.derivatives(pair, law, bands, gradient, &hessian);
    CHECK((hessian - hessian.transpose()).norm() <= 1e-12 * hessian.norm());
    const Vec18 values = Eigen::SelfAdjointEigenSolver<Mat18>(hessian).eigenvalues();
    CHECK(values.minCoeff() >= -1e-12 * std::max(1.0, values.maxCoeff()));
    largest = std::max(largest, values.maxCoeff());
  }
  CHECK(largest > 0.1);
}

struct PackCounts {
  int found = 0, empty = 0;
};
// Compares the pairs of a pack with the same one by one.
void compare_pack(const std::array<ClippedPair, pack_width>& pairs, const PairLaw& law, const GapBands& bands, PackCounts& counts, double margin = 1e-12) {
  ClipIntegrator integrator;
  ClipPack pack;
  for (int l = 0; l < pack_width; ++l) {
    VecX x(18);
    for (int k = 0; k < 6; ++k) vertex(x, k) = k < 3 ? pairs[l].a[k] : pairs[l].b[k - 3];
    pack.set(l, x, {0, 1, 2, 3, 4, 5}, pairs[l].strip_b, pairs[l].boundary_a, pairs[l].owns_b, false);
  }
  const unsigned plain = pack.clip(bands);
  std::array<double, 2 * pack_width> values;
  std::array<LawSample, 2 * pack_width> samples;
  law.values(2 * pack_width, pack.gaps(), values.data());
  law.samples(2 * pack_width, pack.gaps(), samples.data());
  const Pack energy = pack.energy(values.data());
  std::array<Pack, 18> gradient;
  std::array<Pack, ClipPack::hessian_slots> hessian;
  pack.derivatives(samples.data(), gradient.data(), hessian.data());
  for (int l = 0; l < pack_width; ++l) {
    if ((plain >> l & 1u) == 0) continue;
    INFO("lane " << l);
    Vec18 g;
    Mat18 h;
    const ClippedIntegral one = integrator.derivatives(pairs[l], law, bands, g, &h), in_pack = pack.integral(l, energy[l]);
    ++(one.energy == 0 ? counts.empty : counts.found);
    CHECK(energy[l] == Approx(one.energy).margin(1e-13));
    for (int k = 0; k < 3; ++k) {
      CHECK(in_pack.area[k] == Approx(one.area[k]).margin(1e-13));
      CHECK(in_pack.area_a[k] == Approx(one.area_a[k]).margin(1e-13));
    }
    if (std::abs(one.energy) > 1e-8) CHECK(in_pack.gap == Approx(one.gap).margin(1e-13));
    std::array<double, ClipPack::hessian_slots> blocks;
    store_blocks<6>(h, blocks.data());
    for (int i = 0; i < 18; ++i) REQUIRE(gradient[i][l] == Approx(g[i]).margin(margin));
    for (int i = 0; i < ClipPack::hessian_slots; ++i) REQUIRE(hessian[i][l] == Approx(blocks[i]).margin(margin));
  }
}

TEST_CASE("packs of pairs give what pairs give one by one", "[clipped]") {
  std::mt19937 random(10);
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  PackCounts counts;
  for (int trial = 0; trial < 400; ++trial) {
    INFO("trial " << trial);
    std::array<ClippedPair, pack_width> pairs;
    for (int l = 0; l < pack_width; ++l) {
      pairs[l] = random_pair(random, l % 4 == 3 ? 1.5 : l % 4 == 2 ? 0 : 0.05);
      if (l % 2) pairs[l].strip_b = {l % 3 == 0 ? 0.25 : 0, l % 3 == 1 ? 0.25 : 0, l % 3 == 2 ? 0.25 : 0};
      pairs[l].boundary_a = {trial % 2 == 0, trial % 3 == 0, trial % 5 == 0};
    }
    compare_pack(pairs, law, bands, counts);
  }
  CHECK(counts.found > 500);
  CHECK(counts.empty > 50);
}

TEST_CASE("packs of triangles inside others give what pairs give one by one", "[clipped]") {
  std::mt19937 random(13);
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  PackCounts counts;
  for (int trial = 0; trial < 200; ++trial) {
    INFO("trial " << trial);
    std::array<ClippedPair, pack_width> pairs;
    for (ClippedPair& pair : pairs) {
      pair = random_pair(random, 0.1);
      const Vec3 centre(0.8 + 0.02 * (trial % 10), 0.6, 0.3);
      for (Vec3& corner : pair.a) corner = centre + 0.1 * (corner - pair.b[0]);
      if (trial % 2) pair.strip_b = {0.6, 0, 0};
      pair.boundary_a = {true, false, true};
    }
    compare_pack(pairs, law, bands, counts);
  }
  CHECK(counts.found > 120 * static_cast<int>(pack_width));  // of 200 packs, whose width depends on the processor
}

// Corners on a grid: edges along each other, corners on lines and on corners; exactly or nearly so.
TEST_CASE("packs of pairs on common lines give what pairs give one by one", "[clipped]") {
  std::mt19937 random(11);
  const PairLaw law = tent_law();
  const GapBands bands = gap_bands(law);
  const auto one_of = [&](int n) { return static_cast<int>(random() % static_cast<unsigned>(n)); };
  const auto grid_triangle = [&](bool up) {
    for (;;) {
      std::array<Vec3, 3> t;
      for (Vec3& corner : t) corner = Vec3(one_of(4), one_of(4), 0);
      if ((t[1] - t[0]).cross(t[2] - t[0]).z() * (up ? 1 : -1) > 0) return t;
    }
  };
  PackCounts counts;
  for (int trial = 0; trial < 2000; ++trial) {
    const double off = trial % 2 ? 1e-9 : 0;
    INFO("trial " << trial);
    std::array<ClippedPair, pack_width> pairs;
    for (ClippedPair& pair : pairs) {
      pair.a = grid_triangle(false);
      pair.b = grid_triangle(true);
      const double slope = 0.02 * one_of(4);
      for (Vec3& corner : pair.a) corner += Vec3(off * (one_of(3) - 1), off * (one_of(3) - 1), 0.2 + slope * corner.x());
      for (int k = 0; k < 3; ++k) {
        pair.owns_b[k] = one_of(2) == 0;
        pair.boundary_a[k] = one_of(2) == 0;
        pair.strip_b[k] = one_of(4) == 0 ? 0.2 : 0;
      }
    }
    // A corner that is off a line by 1e-9 moves the ends of sides by as much.
    compare_pack(pairs, law, bands, counts, off > 0 ? 1e-6 : 1e-12);
  }
  CHECK(counts.found > 2000);
  CHECK(counts.empty > 2000);
}

TEST_CASE("a gap that is even up to round-off may lie at a level", "[clipped]") {
  // A law that no parabola fits: the force of a level is not zero, and is divided by the slope of the
  // gap.
  const PairLaw law = steep_law();
  const GapBands bands = gap_bands(law);
  std::mt19937 random(12);
  std::uniform_real_distribution<double> u(-1, 1);
  ClipIntegrator integrator;
  for (const double spread : {0.0, 1e-17, 1e-16, 1e-15, 1e-14, 1e-12, 1e-9, 1e-6}) {
    INFO("spread " << spread);
    for (int trial = 0; trial < 100; ++trial) {
      const double level = bands[1 + trial % (bands.size() - 2)];
      ClippedPair pair = random_pair(random, 0);
      pair.b = {Vec3(0, 0, 0), Vec3(2, 0, 0), Vec3(0.5, 1.8, 0)};
      ClippedPair below = pair;
      for (int k = 0; k < 3; ++k) {
        pair.a[k].z() = level + spread * u(random);
        below.a[k].z() = (1 - 1e-3) * level;
      }
      Vec18 gradient, expected;
      integrator.derivatives(pair, law, bands, gradient, nullptr);
      integrator.derivatives(below, law, bands, expected, nullptr);
      // Of gradients up to 2.
      CHECK((gradient - expected).cwiseAbs().maxCoeff() < 0.01);
    }
  }
}

TEST_CASE("the boundary weight keeps area and its first moment", "[clipped]") {
  double zeroth = 0, first = 0;
  constexpr int points = 2000;
  for (int i = 0; i < points; ++i) {
    const double t = (i + 0.5) / points;
    zeroth += (1 - BoundaryWeight::at(t).value) / points;
    first += t * (1 - BoundaryWeight::at(t).value) / points;
  }
  CHECK(std::abs(zeroth) < 1e-6);
  CHECK(std::abs(first) < 1e-6);
  CHECK(BoundaryWeight::at(0).value == 0);
  CHECK(BoundaryWeight::at(1).value == 1);
  CHECK(BoundaryWeight::at(1 - 1e-12).slope == Approx(0).margin(1e-9));
}

}  // namespace
}  // namespace tack
