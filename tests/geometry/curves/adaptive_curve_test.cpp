#include "geometry/curves/adaptive_curve.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <random>

using namespace tack;

namespace {

constexpr double range = 5e-3;

double exponential(double d) { return d / 3e-4 * std::exp(1 - d / 3e-4); }
double triangle(double d) { return std::max(0.0, std::min(d / 1.1e-3, (3.7e-3 - d) / 2.6e-3)); }  // kinks that no knot is put on
double steep(double d) { return std::exp(-std::pow((d - 2.3456e-3) / 4e-5, 2)); }

// Returns the largest difference at positions that the refinement did not test.
double error_of(const CubicCurve& curve, const std::function<double(double)>& f) {
  double error = 0;
  std::mt19937 random(1);
  std::uniform_real_distribution<double> place(0, curve.last());
  for (int i = 0; i < 200000; ++i) {
    const double d = place(random);
    error = std::max(error, std::abs(curve.at(d).value - f(d)));
  }
  return error;
}

}  // namespace

TEST_CASE("adaptive curves have the stated error for smooth functions, kinks and narrow peaks", "[curves]") {
  for (const auto& f : {exponential, triangle, steep}) {
    const AdaptiveCurve sampled = adaptive_curve(f, 0, range);
    CHECK(sampled.error <= AdaptiveCurve::tolerance);
    CHECK(error_of(sampled.curve, f) <= 2e-6);
    CHECK(sampled.curve.knots() < 700);
  }
  CHECK(adaptive_curve(triangle, 0, range).curve.total() == Approx(3.7e-3 / 2).epsilon(1e-7));
}

TEST_CASE("a cubic needs only the initial knots", "[curves]") {
  const AdaptiveCurve sampled = adaptive_curve([](double d) { return d * (range - d) * (range - d); }, 0, range);
  CHECK(sampled.curve.knots() == 129);
  CHECK(sampled.error < 1e-9);
}

TEST_CASE("adaptive derivatives have the stated error", "[curves]") {
  const auto energy = [](double d) { return -3e-4 * std::exp(1.0) * (1 + d / 3e-4) * std::exp(-d / 3e-4); };
  const AdaptiveCurve smooth = adaptive_derivative(energy, 0, range);
  CHECK(smooth.error <= AdaptiveCurve::tolerance);
  CHECK(error_of(smooth.curve, exponential) <= 2e-6);
  const auto plain = [](double d) {  // the energy of the triangle
    if (d < 1.1e-3) return d * d / 2.2e-3 - 1.85e-3;
    return d < 3.7e-3 ? -(3.7e-3 - d) * (3.7e-3 - d) / 5.2e-3 : 0.0;
  };
  const AdaptiveCurve kinked = adaptive_derivative(plain, 0, range);
  CHECK(kinked.error <= AdaptiveCurve::tolerance);
  CHECK(error_of(kinked.curve, triangle) <= 3e-6);
}

TEST_CASE("a jump is found and reported", "[curves]") {
  const AdaptiveCurve sampled = adaptive_curve([](double d) { return d < 1.234e-3 ? 1.0 : 0.0; }, 0, range);
  CHECK(sampled.error > 0.1);
  CHECK(sampled.worst_from <= 1.234e-3);
  CHECK(sampled.worst_to >= 1.234e-3);
  CHECK(sampled.worst_to - sampled.worst_from < 1e-8 * range);
}

TEST_CASE("a function that never converges uses all knots", "[curves]") {
  const AdaptiveCurve sampled = adaptive_curve([](double d) { return std::sin(1e7 * d); }, 0, range);
  CHECK(sampled.curve.knots() == AdaptiveCurve::most_knots);
  CHECK(sampled.error > AdaptiveCurve::tolerance);
}

TEST_CASE("results do not depend on the unit of length", "[curves]") {
  const AdaptiveCurve large = adaptive_curve(triangle, 0, range);
  const AdaptiveCurve small = adaptive_curve([](double d) { return 1e9 * triangle(1e6 * d); }, 0, 1e-6 * range);
  CHECK(std::abs(small.curve.knots() - large.curve.knots()) <= 4);
  CHECK(small.error <= AdaptiveCurve::tolerance);
}
