#include "geometry/curves/cubic_curve.hpp"

#include <algorithm>
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

using namespace tack;

namespace {

// x^3 - 2 x + 3, which pieces of it are exactly.
double cubic(double x) { return x * x * x - 2 * x + 3; }
double cubic_slope(double x) { return 3 * x * x - 2; }
double cubic_integral(double x) { return x * x * x * x / 4 - x * x + 3 * x; }

template <class F>
std::vector<double> of(const std::vector<double>& x, const F& f) {
  std::vector<double> values;
  for (const double at : x) values.push_back(f(at));
  return values;
}

// A traction that rises, stays, falls and ends, between gaps that differ a thousand times.
const std::vector<double> gaps = {0, 0.001, 0.3, 0.5, 1.5, 1.6, 2.5}, tractions = {0, 0.2, 2, 2, 1, 0.1, 0};

}  // namespace

TEST_CASE("pieces of a cubic are that cubic, and its integral", "[curves]") {
  const std::vector<double> x = {-1, -0.9, 0.2, 0.2001, 2.5, 4};
  const CubicCurve curve(x, of(x, cubic), of(x, cubic_slope));
  for (int i = 0; i <= 1000; ++i) {
    const double at = -1 + 5.0 * i / 1000;
    const CubicCurve::Sample s = curve.at(at);
    CHECK(s.value == Approx(cubic(at)).epsilon(1e-12).margin(1e-12));
    if (i > 0 && i < 1000) CHECK(s.slope == Approx(cubic_slope(at)).epsilon(1e-9).margin(1e-9));
    CHECK(s.integral == Approx(cubic_integral(at) - cubic_integral(-1)).epsilon(1e-11).margin(1e-12));
    CHECK(s.integral + s.rest == Approx(curve.total()).epsilon(1e-13));
  }
}

TEST_CASE("slopes of a monotone curve are those of Fritsch and Butland", "[curves]") {
  const CubicCurve curve = CubicCurve::monotone({0, 1, 3, 4}, {0, 1, 2, 5});
  CHECK(curve.at(1).slope == Approx(9.0 / (5 / 1.0 + 4 / 0.5)).epsilon(1e-14));
  CHECK(curve.at(3).slope == Approx(9.0 / (4 / 0.5 + 5 / 3.0)).epsilon(1e-14));
  CHECK(curve.at(1e-12).slope == Approx((4 * 1 - 0.5) / 3).epsilon(1e-9));  // (2 h0 + h1) d0 - h0 d1 over h0 + h1
  CHECK(curve.at(4 - 1e-12).slope == Approx((4 * 3 - 0.5) / 3).epsilon(1e-9));
  CHECK(curve.total() == Approx(6.718096080165045).epsilon(1e-14));
}

TEST_CASE("a monotone curve interpolates its values, does not overshoot, and has a continuous slope", "[curves]") {
  const CubicCurve curve = CubicCurve::monotone(gaps, tractions);
  for (size_t i = 0; i < gaps.size(); ++i) CHECK(curve.at(gaps[i]).value == Approx(tractions[i]).margin(1e-14));
  for (size_t i = 0; i + 1 < gaps.size(); ++i) {
    const auto [low, high] = std::minmax(tractions[i], tractions[i + 1]);
    for (int k = 0; k <= 200; ++k) {
      const double value = curve.at(gaps[i] + (gaps[i + 1] - gaps[i]) * k / 200).value;
      CHECK((value >= low - 1e-14 && value <= high + 1e-14));
    }
  }
  for (size_t i = 1; i + 1 < gaps.size(); ++i)
    CHECK(curve.at(gaps[i] - 1e-9).slope == Approx(curve.at(gaps[i] + 1e-9).slope).epsilon(1e-4).margin(1e-5));
  CHECK(curve.least().value == 0);
  CHECK(curve.largest().value == 2);
  CHECK(curve.largest().x == 0.3);
  CHECK(curve.largest(1.0).value == Approx(curve.at(1.0).value));
}

TEST_CASE("slope, value and integral are consistent, and the remaining integral has no cancellation", "[curves]") {
  const CubicCurve curve = CubicCurve::monotone(gaps, tractions);
  for (int i = 1; i < 997; ++i) {
    const double x = 2.5 * i / 997, h = 1e-6;
    if (std::any_of(gaps.begin(), gaps.end(), [&](double gap) { return std::abs(gap - x) <= h; })) continue;
    CHECK((curve.at(x + h).value - curve.at(x - h).value) / (2 * h) == Approx(curve.at(x).slope).epsilon(1e-6).margin(1e-6));
    CHECK((curve.at(x + h).integral - curve.at(x - h).integral) / (2 * h) == Approx(curve.at(x).value).epsilon(1e-6).margin(1e-6));
  }
  // near the end the curve is y''/2 s^2 + ..., its rest a third of s times that
  for (const double s : {1e-3, 1e-6, 1e-9}) CHECK(curve.at(2.5 - s).rest == Approx(curve.at(2.5 - s).value * ((2.5 - (2.5 - s))) / 3).epsilon(2e-3));
}

TEST_CASE("largest values between knots are found", "[curves]") {
  const CubicCurve arch({0, 1, 3}, {0, 0, 0}, {1, -1, 0.5});  // x - x^2 first
  CHECK(arch.largest().x == Approx(0.5));
  CHECK(arch.largest().value == Approx(0.25));
  CHECK(arch.least().value < 0);
}

TEST_CASE("beyond its ends a curve is constant", "[curves]") {
  const CubicCurve curve({1, 2}, {3, 5}, {2, 2});
  CHECK(curve.at(0).value == 3);
  CHECK(curve.at(0).integral == -3);
  CHECK(curve.at(4).value == 5);
  CHECK(curve.at(4).slope == 0);
  CHECK(curve.at(4).integral == 14);
}

TEST_CASE("invalid knots are refused", "[curves]") {
  CHECK_THROWS_AS(CubicCurve::monotone({1}, {1}), std::logic_error);
  CHECK_THROWS_AS(CubicCurve::monotone({1, 1}, {1, 2}), std::logic_error);
  CHECK_THROWS_AS(CubicCurve::monotone({1, 2}, {1, std::nan("")}), std::logic_error);
}

TEST_CASE("the piece of a position is found among many knots of uneven spacing", "[curves]") {
  std::vector<double> x = {0};
  for (int i = 0; i < 4000; ++i) x.push_back(x.back() + (i % 100 < 60 ? 1e-9 : 0.01));
  const CubicCurve curve = CubicCurve::monotone(x, of(x, [](double at) { return std::sin(at); }));
  for (size_t i = 0; i + 1 < x.size(); ++i)
    for (const double u : {0.0, 0.3, 0.999}) {
      const double at = x[i] + u * (x[i + 1] - x[i]);
      REQUIRE(curve.at(at).value == Approx(std::sin(at)).margin(1e-5));
    }
}
