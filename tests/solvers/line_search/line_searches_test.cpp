// Properties of every line search.
#include <catch2/catch.hpp>
#include <cmath>

#include "framework/config/registry.hpp"
#include "solvers/line_search/line_search.hpp"
#include "tests/support/line.hpp"

using namespace tack;

namespace {

LineSearchResult search(const std::string& type, Line& line, double from, double p, double t_max = 1) {
  const VecX q = VecX::Constant(1, from), direction = VecX::Constant(1, p);
  line.move_to(q);
  const double slope = line.gradient()(0) * p;
  const LineSearchResult found = Registry<LineSearch>::make(type)->search(line, q, direction, slope, t_max);
  if (found.found) CHECK(line.x == Approx(from + found.step * p).margin(1e-14 * std::abs(from)));
  CHECK(found.evaluations >= 1);
  CHECK(found.evaluations <= 60);
  return found;
}

}  // namespace

TEST_CASE("line searches", "[line_search]") {
  const std::string type = GENERATE(from_range(Registry<LineSearch>::kind().names()));
  INFO(type);
  SECTION("take Newton's step of a parabola, or the feasible part") {
    Line parabola([](double x) { return x * x; }, [](double x) { return 2 * x; });
    CHECK(search(type, parabola, 3, -3).step == 1);
    CHECK(search(type, parabola, 3, -3, 0.25).step == 0.25);
  }
  SECTION("lower the energy where a step goes too far") {
    Line steep([](double x) { return std::pow(x, 4); }, [](double x) { return 4 * std::pow(x, 3); });
    const LineSearchResult r = search(type, steep, 1, -10);
    REQUIRE(r.found);
    CHECK(std::pow(1 - 10 * r.step, 4) < 1);
  }
  SECTION("stay clear of where the value is infinite or not a number") {
    for (const double outside : {std::numeric_limits<double>::infinity(), std::nan("")}) {
      Line wall([=](double x) { return x > 0 ? x - std::log(x) : outside; }, [](double x) { return 1 - 1 / x; });
      const LineSearchResult r = search(type, wall, 3, -50);
      REQUIRE(r.found);
      CHECK(3 - 50 * r.step > 0);
    }
  }
  SECTION("give up on a slope that lies") {
    Line climb([](double x) { return x; }, [](double) { return -1.0; });
    CHECK_FALSE(search(type, climb, 5, 1).found);
  }
  SECTION("trust the slope where the value is all round-off") {
    // 1e8 swallows the parabola; rounding of the value is far above the decrease of a step.
    Line shallow([](double x) { return 1e8 + 1e-10 * x * x; }, [](double x) { return 2e-10 * x; }, 1e-7);
    const LineSearchResult r = search(type, shallow, 1, -1);
    CHECK(r.step == 1);
    CHECK(r.evaluations == 1);
  }
}

TEST_CASE("strong Wolfe: the slope flattens", "[line_search]") {
  // Far too short a step of a quartic is feasible only up to 1: the search continues to the minimum at 0.8.
  Line well([](double x) { return std::pow(x - 0.8, 4) + 0.1 * std::pow(x - 0.8, 2); },
            [](double x) { return 4 * std::pow(x - 0.8, 3) + 0.2 * (x - 0.8); });
  const auto wolfe = Registry<LineSearch>::make("strong_wolfe");
  const VecX q = VecX::Constant(1, 0.0), p = VecX::Constant(1, 4.0);
  well.move_to(q);
  const double start = well.value(), slope = 4 * well.gradient()(0);
  const LineSearchResult r = wolfe->search(well, q, p, slope, 1);
  REQUIRE(r.found);
  CHECK(well.value() <= start + 1e-4 * r.step * slope);
  CHECK(std::abs(4 * well.gradient()(0)) <= 0.9 * std::abs(slope));
}
