#include "framework/measured/deviation.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tack;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();

MeasuredCurve curve() { return {"load.csv", {0, 1, 3}, {10, 20, 40}, {2, 3, 4}}; }

}  // namespace

TEST_CASE("deviations of a run from a measured curve agree with hand calculation", "[measured]") {
  const Deviation d = deviation_of(curve(), {11, 16, 40}, DeviationScale::point);
  CHECK(d.compared == 3);
  CHECK(d.mean == Approx(0.1));
  CHECK(d.bias == Approx(-0.1 / 3));
  CHECK(d.rms == Approx(std::sqrt((0.01 + 0.04) / 3)));
  CHECK(d.worst == Approx(0.2));
  CHECK(d.worst_at == 1);
  CHECK(d.work == Approx(13.5 + 56));
  CHECK(d.measured_work == Approx(15 + 60));
  const Deviation of_peak = deviation_of(curve(), {11, 16, 40}, DeviationScale::peak);
  CHECK(of_peak.mean == Approx(5.0 / 40 / 3));
  CHECK(of_peak.worst == Approx(0.1));
}

TEST_CASE("points that a run never passed do not count", "[measured]") {
  const Deviation d = deviation_of(curve(), {11, nan_value, 44}, DeviationScale::point);
  CHECK(d.compared == 2);
  CHECK(d.mean == Approx(0.1));
  CHECK(d.measured_work == Approx(75));
  CHECK(deviation_of(curve(), {nan_value, nan_value, nan_value}, DeviationScale::point).compared == 0);
}

TEST_CASE("the deviation relative to a measured zero is infinite", "[measured]") {
  const MeasuredCurve zero{"", {0, 1}, {0, 2}, {1, 2}};
  CHECK(std::isinf(deviation_of(zero, {0.1, 2}, DeviationScale::point).worst));
  CHECK(deviation_of(zero, {0, 2}, DeviationScale::point).worst == 0);
  CHECK(deviation_of(zero, {0.1, 2}, DeviationScale::peak).worst == Approx(0.05));
}
