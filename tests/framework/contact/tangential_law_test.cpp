// Slip laws against the formulas of the paper, on each side of their kinks.
#include "framework/contact/tangential_law.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/dense_term.hpp"

using namespace tack;

namespace {

constexpr double e = 2e-5;  // m
const std::vector<double> parts = {1e-4, 0.1, 0.5, 0.9, 0.999, 1.001, 1.3, 1.7, 1.999, 2.001, 3, 50};

double quadratic(double r) { return -r * r + 2 * r; }
double friction_slope(double r) { return r < 1 ? quadratic(r) : 1; }
double adhesion_slope(double r) { return r < 2 ? quadratic(r) : 0; }

template <class Sample, class Slope>
void check_law(const Sample& sample, const Slope& slope) {
  for (const double r : parts) {
    INFO("y = " << r << " e");
    const double y = r * e;
    const SlipSample s = sample(y, e);
    CHECK(s.slope_over_y * y == Approx(slope(r)).margin(1e-14));
    const double step = 1e-4 * e;
    CHECK(central_difference([&](double d) { return sample(y + d, e).value; }, step) ==
          Approx(slope(r)).margin(1e-9));
    CHECK(central_difference([&](double d) { return slope((y + d) / e); }, step) * e ==
          Approx(s.curvature * e).margin(1e-8));
  }
  const SlipSample rest = sample(0, e);
  CHECK(rest.value == 0);
  CHECK(rest.slope_over_y == Approx(2 / e));
  CHECK(rest.curvature == Approx(2 / e));
}

template <class Sample>
void check_continuous(const Sample& sample, double kink) {
  const SlipSample below = sample(kink * (1 - 1e-13), e), above = sample(kink * (1 + 1e-13), e);
  CHECK(below.value == Approx(above.value).epsilon(1e-12));
  CHECK(below.slope_over_y * e == Approx(above.slope_over_y * e).margin(1e-12));
}

}  // namespace

TEST_CASE("friction: f0' = f1 of the paper", "[friction]") {
  check_law(friction_slip, friction_slope);
  check_continuous(friction_slip, e);
  CHECK(friction_slip(e, e).curvature == 0);  // continuous there too
  CHECK(friction_slip(e, e).value == Approx(2 * e / 3));
  CHECK(friction_slip(1.0, e).value == Approx(1 - e / 3));
}

TEST_CASE("tangential adhesion: f_t0' = f_t of the paper", "[friction]") {
  check_law(adhesion_slip, adhesion_slope);
  check_continuous(adhesion_slip, 2 * e);
  CHECK(adhesion_slip(e, e).slope_over_y * e == Approx(1));  // the peak
  CHECK(adhesion_slip(2 * e, e).value == Approx(4 * e / 3));
  CHECK(adhesion_slip(1.0, e).value == Approx(4 * e / 3));
}

TEST_CASE("static friction: the excess falls to nothing at the Stribeck speed", "[friction]") {
  constexpr double end = 5 * e;
  const auto excess = [](double y, double start) { return static_slip(y, start, end / e * start); };
  check_law(excess, [](double r) {
    const double t = (r - 1) / 4;
    return r < 1 ? quadratic(r) : t < 1 ? 1 - t * t * (3 - 2 * t) : 0;
  });
  for (const double kink : {e, end}) {
    check_continuous(excess, kink);
    CHECK(excess(kink * (1 - 1e-13), e).curvature * e == Approx(excess(kink * (1 + 1e-13), e).curvature * e).margin(1e-10));
  }
  CHECK(excess(e, e).slope_over_y * e == Approx(1));  // the peak
  CHECK(excess(7 * e, e).value == Approx(2 * e / 3 + 2 * e));
}
