#include "geometry/curves/smoothed.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace tack;

TEST_CASE("straight lines stay for any spacing", "[curves]") {
  std::vector<double> x, y;
  for (int i = 0; i < 100; ++i) x.push_back(i + 0.4 * std::sin(7.0 * i)), y.push_back(3 - 2 * x.back());
  const auto smooth = smoothed(x, y, 5);
  for (size_t i = 0; i < x.size(); ++i) CHECK(smooth[i] == Approx(y[i]).margin(1e-10));
}

TEST_CASE("values without a neighbour within the half width stay", "[curves]") {
  CHECK(smoothed({0, 1, 3}, {1, 5, 2}, 0.5) == std::vector<double>{1, 5, 2});
}

TEST_CASE("noise is removed, and wide features stay", "[curves]") {
  std::mt19937 random(3);
  std::normal_distribution<double> noise(0, 0.01);
  std::vector<double> x, exact, y;
  for (int i = 0; i < 400; ++i) {
    x.push_back(i / 400.0);
    exact.push_back(std::sin(3 * x.back()));
    y.push_back(exact.back() + noise(random));
  }
  const auto smooth = smoothed(x, y, 0.05);
  double before = 0, after = 0;
  for (size_t i = 0; i < x.size(); ++i) before += std::pow(y[i] - exact[i], 2), after += std::pow(smooth[i] - exact[i], 2);
  CHECK(std::sqrt(after / before) < 0.35);
  CHECK(count_reversals(y, 0.005) > 100);
  CHECK(count_reversals(smooth, 0.005) <= 5);
}

TEST_CASE("reversals larger than the threshold are counted", "[curves]") {
  CHECK(count_reversals({0, 1, 2, 1, 0}, 0.1) == 1);
  CHECK(count_reversals({0, 1, 0.95, 2, 0}, 0.1) == 1);
  CHECK(count_reversals({0, 1, 0.8, 2, 0}, 0.1) == 3);
  CHECK(count_reversals({2, 1, 0}, 0.1) == 0);
  CHECK(count_reversals({}, 0.1) == 0);
}
