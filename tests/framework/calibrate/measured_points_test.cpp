// Residuals and derivatives of measured points, for given samples of a run.
#include "framework/calibrate/measured_points.hpp"

#include <catch2/catch.hpp>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

MeasuredPoints points(std::vector<double> x, std::vector<double> y) {
  MeasuredPoints p;
  p.name = "pull";
  p.x = "gap";
  p.y = "force";
  std::vector<int> lines(x.size(), 1);
  p.curve = {"pull.csv", std::move(x), std::move(y), std::move(lines)};
  p.scale = 2;
  p.weight = 4;
  return p;
}

}  // namespace

TEST_CASE("residuals are in units of the noise, times the square root of the weight", "[calibrate]") {
  int beyond = -1;
  const MeasuredPoints p = points({0.5, 1.5}, {10, 10});
  const std::vector<double> found = p.simulated({{"time", "gap", "force"}, {{0, 0, 0}, {1, 1, 10}, {2, 2, 30}}}, beyond);
  CHECK(found == std::vector<double>{5, 20});
  CHECK(beyond == 0);
  CHECK(p.residuals(found) == std::vector<double>{-5, 10});
}

TEST_CASE("the derivative at a measured x is dy minus the slope of the curve times dx", "[calibrate]") {
  // y = p^2 x over x = p t, at p = 2: dy/dp at x is 2 p x.
  const double p = 2;
  ProbeSeries run{{"time", "gap", "force"}, {}};
  std::vector<double> dx, dy;
  for (int i = 0; i <= 4; ++i) {
    const double t = 0.25 * i;
    run.rows.push_back({t, p * t, p * p * p * t});
    dx.push_back(t);
    dy.push_back(3 * p * p * t);
  }
  const std::vector<double> found = points({0, 0.3, 1.1, 2, 5}, {1, 1, 1, 1, 1}).derivatives(run, dx, dy);
  const double root = 2, scale = 2;
  for (const auto& [i, x] : {std::pair(0, 0.0), std::pair(1, 0.3), std::pair(2, 1.1), std::pair(3, 2.0)}) CHECK(found[i] == Approx(root / scale * 2 * p * x));
  CHECK(found[4] == Approx(root / scale * dy.back()));  // beyond the run: the derivative of the last sample
}

TEST_CASE("unreached points are compared with the nearest sample; a run that reaches none is an error", "[calibrate]") {
  int beyond = -1;
  const ProbeSeries run{{"time", "gap", "force"}, {{0, 0, 1}, {1, 1, 10}, {2, 2, 30}}};
  CHECK(points({-1, 1, 5, 9}, {0, 0, 0, 1}).simulated(run, beyond) == std::vector<double>{1, 10, 30, 30});
  CHECK(beyond == 3);
  CHECK_THROWS_WITH(points({5, 9}, {0, 1}).simulated(run, beyond), Catch::Contains("reaches none of the measured points: its gap goes from 0 to 2, that of pull.csv from 5 to 9"));
  CHECK_THROWS_WITH(points({1, 2}, {0, 1}).simulated({{"time", "gap", "force"}, {}}, beyond), Catch::Contains("no samples"));
  CHECK_THROWS_WITH(points({1, 2}, {0, 1}).simulated({{"time", "gap", "force"}, {{0, NAN, 1}}}, beyond), Catch::Contains("not finite"));
}
