#include "geometry/level_set/gradient_noise.hpp"

#include <catch2/catch.hpp>

#include <cmath>
#include <random>

using namespace tack;

TEST_CASE("gradient noise is smooth, has zero mean, and is no steeper than its bound", "[level_set]") {
  std::mt19937 random(5);
  std::uniform_real_distribution<double> anywhere(-50, 50);
  double sum = 0, most = 0, steepest = 0;
  constexpr int count = 200000;
  for (int i = 0; i < count; ++i) {
    const Vec3 p(anywhere(random), anywhere(random), anywhere(random));
    const double value = gradient_noise(p, 7);
    sum += value;
    most = std::max(most, std::abs(value));
    Vec3 slope;
    for (int k = 0; k < 3; ++k)
      slope[k] = (gradient_noise(p + 1e-5 * Vec3::Unit(k), 7) - gradient_noise(p - 1e-5 * Vec3::Unit(k), 7)) / 2e-5;
    steepest = std::max(steepest, slope.norm());
  }
  CHECK(std::abs(sum / count) < 5e-3);
  CHECK(most < 1.05);
  CHECK(most > 0.6);
  CHECK(steepest < gradient_noise_slope);
  CHECK(steepest > 0.5 * gradient_noise_slope);
  CHECK(gradient_noise(Vec3(0.3, 0.4, 0.5), 1) != gradient_noise(Vec3(0.3, 0.4, 0.5), 2));
  CHECK(gradient_noise(Vec3(3, -4, 5), 1) == 0);  // at the nodes of its lattice
}
