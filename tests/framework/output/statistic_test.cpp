#include "framework/output/statistic.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

// A force over a gap that opens and closes, with uneven steps.
ProbeSeries pull() {
  return {{"time", "force", "gap"}, {{0, 0, 1}, {1, 4, 2}, {3, -6, 4}, {4, 2, 3}}};
}

StatisticValue value(Statistic statistic, StatisticQuery query = {}) {
  query.statistic = statistic;
  query.probe = "force";
  return evaluate(query, pull());
}

StatisticQuery over(double t0, double t1) {
  StatisticQuery query;
  query.over = {t0, t1};
  return query;
}

}  // namespace

TEST_CASE("statistics of all samples") {
  CHECK(value(Statistic::final).value == 2);
  CHECK(value(Statistic::max).value == 4);
  CHECK(value(Statistic::min).value == -6);
  CHECK(value(Statistic::peak).value == 6);
  // Trapezoids 2, -2, -2; the plain average of the samples would be 0.
  CHECK(value(Statistic::integral).value == Approx(-2));
  CHECK(value(Statistic::mean).value == Approx(-0.5));
}

TEST_CASE("statistics of the samples in a window, ends included") {
  CHECK(value(Statistic::final, over(0, 1)).value == 4);
  CHECK(value(Statistic::max, over(3, 4)).value == 2);
  CHECK(value(Statistic::min, over(0.5, 1.5)).value == 4);
  CHECK(value(Statistic::peak, over(0, 2)).value == 4);
  CHECK(value(Statistic::integral, over(1, 4)).value == Approx(-4));
  CHECK(value(Statistic::mean, over(0, 1)).value == Approx(2));
  CHECK(value(Statistic::mean, over(1, 1)).value == 4);
}

TEST_CASE("nothing is interpolated between the windows of a stage") {
  // Pressed twice to a gap of 0, with a retraction between; over the gap the force is another each time.
  const ProbeSeries series{{"time", "force", "gap"}, {{0, 1, 3}, {1, 3, 1}, {2, -9, 8}, {3, 10, 4}, {5, 20, 2}}};
  const auto of = [&](Statistic statistic, const TimeWindows& windows, double where = 0) {
    StatisticQuery query;
    query.statistic = statistic;
    query.probe = "force";
    query.along = statistic == Statistic::mean ? "time" : "gap";
    query.where = where;
    return evaluate(query, series, windows);
  };
  using List = std::vector<TimeWindow>;
  const TimeWindows pressed = List{{0, 1}, {3, 5}};
  CHECK(of(Statistic::mean, pressed).value == Approx((2 + 30) / 3.0));
  CHECK(of(Statistic::integral, pressed).value == Approx(-4 - 30));
  CHECK(of(Statistic::at, pressed, 2).value == Approx(2));
  CHECK(of(Statistic::at, pressed, 3.5).value == Approx(12.5));  // 1 to 4 is no movement
  CHECK(of(Statistic::min, pressed).value == 1);
  CHECK(of(Statistic::final, pressed).value == 20);
  CHECK(of(Statistic::integral, List{{0, 0}, {3, 3}}).problem == "an integral needs two samples, there is one in each of 2 times");
  CHECK(of(Statistic::at, List{{0, 0}, {2, 2}}, 5).problem == "gap never reaches 5; it only jumps over it from one time of the stage to the next, between 3 and 8");
  CHECK(of(Statistic::at, pressed, 8).problem == "gap never reaches 8; it stays between 1 and 4");
  CHECK(of(Statistic::mean, List()).problem == "there are no samples");
  CHECK(of(Statistic::mean, std::nullopt).value == of(Statistic::mean, List{{0, 5}}).value);
  // Windows that meet have the sample between them once each.
  CHECK(of(Statistic::mean, List{{0, 1}, {1, 2}}).value == of(Statistic::mean, List{{0, 2}}).value);
}

TEST_CASE("a window tolerates rounding errors of summed steps") {
  const ProbeSeries series{{"time", "p"}, {{0.1 + 0.2, 5}, {0.31, 6}}};
  StatisticQuery query = over(0, 0.3);
  query.probe = "p";
  query.statistic = Statistic::max;
  CHECK(evaluate(query, series).value == 5);
}

TEST_CASE("an integral along another column counts closing as negative") {
  StatisticQuery query;
  query.along = "gap";
  // Opening: (0 + 4)/2 * 1 + (4 - 6)/2 * 2; closing: (-6 + 2)/2 * (-1).
  CHECK(value(Statistic::integral, query).value == Approx(2 - 2 + 2));
}

TEST_CASE("the value where a column first passes a number") {
  StatisticQuery query;
  query.along = "gap";
  query.where = 1.5;
  CHECK(value(Statistic::at, query).value == Approx(2));
  query.where = 1;  // the first sample
  CHECK(value(Statistic::at, query).value == 0);
  query.where = 4;  // a turning point, touched and not crossed
  CHECK(value(Statistic::at, query).value == -6);
  query.where = 3;  // passed upwards first, later met again
  CHECK(value(Statistic::at, query).value == Approx(-1));
  query.along = "time";
  query.where = 3.5;
  CHECK(value(Statistic::at, query).value == Approx(-2));
  query.over = {3, 4};
  query.along = "gap";  // passed downwards
  CHECK(value(Statistic::at, query).value == Approx(-2));
}

TEST_CASE("a value that is never reached is a problem") {
  StatisticQuery query;
  query.along = "gap";
  query.where = 7;
  const StatisticValue result = value(Statistic::at, query);
  CHECK(std::isnan(result.value));
  CHECK(result.problem == "gap never reaches 7; it stays between 1 and 4");
}

TEST_CASE("series without samples, with one sample, and with invalid samples") {
  CHECK(value(Statistic::mean, over(1.2, 1.8)).problem == "there are no samples");
  CHECK(value(Statistic::integral, over(1, 1)).problem ==
        "an integral needs two samples, there is one");
  for (const Statistic s : {Statistic::final, Statistic::mean, Statistic::max, Statistic::min,
                            Statistic::peak, Statistic::integral, Statistic::at}) {
    const ProbeSeries series{{"time", "p"}, {{0, 1}, {0.5, nan_value}, {1, 1}}};
    StatisticQuery query{s, "p", "time", 0.25, {}};
    const StatisticValue result = evaluate(query, series);
    CHECK(std::isnan(result.value));
    CHECK(result.problem == "p is not a number at t = 0.5 s");
    query.over = {1, 2};
    query.where = 1;
    if (s != Statistic::integral) CHECK(evaluate(query, series).value == 1);
  }
}

TEST_CASE("an invalid abscissa matters only where it is used") {
  const ProbeSeries series{{"time", "p", "s"}, {{0, 1, 0}, {1, 2, nan_value}}};
  CHECK(evaluate(StatisticQuery{Statistic::max, "p", "s", 0, {}}, series).value == 2);
  CHECK(evaluate(StatisticQuery{Statistic::integral, "p", "s", 0, {}}, series).problem ==
        "s is not a number at t = 1 s");
}

TEST_CASE("infinite samples are accepted by statistics that stay finite") {
  const ProbeSeries series{{"time", "p"}, {{0, infinity}, {1, 3}}};
  CHECK(evaluate(StatisticQuery{Statistic::min, "p", "time", 0, {}}, series).value == 3);
  CHECK(evaluate(StatisticQuery{Statistic::max, "p", "time", 0, {}}, series).problem == "the max is not finite");
  CHECK(evaluate(StatisticQuery{Statistic::mean, "p", "time", 0, {}}, series).problem ==
        "the mean is not finite");
}

TEST_CASE("an unknown column is an error with the nearest name") {
  CHECK_THROWS_WITH(evaluate(StatisticQuery{Statistic::max, "forse", "time", 0, {}}, pull()),
                    "unknown column 'forse'; did you mean 'force'? (columns: time, force, gap)");
  CHECK_THROWS_AS(evaluate(StatisticQuery{Statistic::integral, "force", "gab", 0, {}}, pull()), InputError);
}
