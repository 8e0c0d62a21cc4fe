#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "solvers/line_search/line_search.hpp"
#include "tests/support/line.hpp"

using namespace tack;

namespace {

LineSearchResult search(Line& line, double from, double p, double t_max = 1) {
  const auto found = Registry<LineSearch>::make("backtracking");
  const VecX q = VecX::Constant(1, from), direction = VecX::Constant(1, p);
  line.move_to(q);
  const double slope = line.gradient()(0) * p;
  return found->search(line, q, direction, slope, t_max);
}

}  // namespace

TEST_CASE("backtracking takes the whole step if it decreases the value", "[line_search]") {
  Line parabola([](double x) { return x * x; }, [](double x) { return 2 * x; });
  const LineSearchResult newton = search(parabola, 3, -3);
  CHECK(newton.found);
  CHECK(newton.step == 1);
  CHECK(newton.evaluations == 1);
  CHECK(parabola.x == 0);  // left at the new point
  const LineSearchResult limited = search(parabola, 3, -3, 0.25);
  CHECK(limited.step == 0.25);
  CHECK(parabola.x == 2.25);
}

TEST_CASE("backtracking shortens a step that goes too far", "[line_search]") {
  Line steep([](double x) { return std::pow(x, 4); }, [](double x) { return 4 * std::pow(x, 3); });
  const LineSearchResult r = search(steep, 1, -10);
  CHECK(r.found);
  CHECK(r.step == 0.125);
  CHECK(std::pow(1 - 10 * r.step, 4) < 1);
  CHECK(r.evaluations == 4);
}

TEST_CASE("backtracking stays clear of where the value is infinite or not a number", "[line_search]") {
  for (const double outside : {std::numeric_limits<double>::infinity(), std::nan("")}) {
    Line wall([=](double x) { return x > 0 ? x - std::log(x) : outside; },
              [](double x) { return 1 - 1 / x; });
    const LineSearchResult r = search(wall, 3, -50);
    CHECK(r.found);
    CHECK(3 - 50 * r.step > 0);
    CHECK(wall.x == Approx(3 - 50 * r.step));
  }
}

TEST_CASE("backtracking fails on an ascent direction", "[line_search]") {
  Line climb([](double x) { return x; }, [](double) { return -1.0; });  // the slope lies
  const LineSearchResult r = search(climb, 0, 1);
  CHECK_FALSE(r.found);
  CHECK(r.evaluations == 60);
}

// Close to the minimum the decrease is below rounding; the slope is not.
TEST_CASE("backtracking trusts the slope where the value is lost in round-off", "[line_search]") {
  constexpr double offset = 1e6, noise = 1e-14 * offset * 10;
  Line shallow([](double x) { return offset + 1e-4 * x * x; }, [](double x) { return 2e-4 * x; }, noise);
  const LineSearchResult good = search(shallow, 1e-4, -1e-4);
  CHECK(good.found);
  CHECK(good.step == 1);
  // A step far past the minimum climbs on the other side: the slope says so.
  const LineSearchResult past = search(shallow, 1e-4, -8e-4);
  CHECK(past.found);
  CHECK(past.step < 1);
  CHECK(std::abs(1e-4 - 8e-4 * past.step) < 1e-4 * 1.01);
}
