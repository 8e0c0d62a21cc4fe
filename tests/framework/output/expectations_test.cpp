#include "framework/output/expectations.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <filesystem>
#include <limits>

#include "framework/config/bind.hpp"
#include "framework/config/describe.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

Expectation expectation(const std::string& yaml) {
  Expectation e;
  bind(parse_string(yaml, "s.yaml"), e, "expect[0]");
  return e;
}

std::string bind_error(const std::string& yaml) {
  try {
    expectation(yaml);
  } catch (const InputError& e) {
    return e.what();
  }
  return "";
}

// The constant value as a series of the column p.
ExpectationResult judged(const std::string& yaml, double value) {
  return evaluate(expectation(yaml), {{"time", "p"}, {{0, value}, {1, value}}});
}

}  // namespace

TEST_CASE("an expectation is read from a scene file") {
  const Expectation e = expectation(
      "{probe: force, statistic: at, along: gap, where: 0.5, over: [0, 100 ms], target: 12.5, "
      "within: 4%}");
  CHECK(e.query.probe == "force");
  CHECK(e.query.statistic == Statistic::at);
  CHECK(e.query.over == std::vector<double>{0, 0.1});
  CHECK(e.where == 0.5);
  CHECK(name_of(e) == "force: at gap = 0.5 from 0 s to 0.1 s");
  CHECK(name_of(expectation("{name: n, probe: p, statistic: max, at_most: 1}")) == "n");
  CHECK(name_of(expectation("{probe: p, statistic: integral, along: x, at_most: 1}")) ==
        "p: integral along x");
}

TEST_CASE("a written expectation reads back as the same expectation") {
  for (const char* yaml : {"{probe: p, statistic: mean, over: [1, 2], target: 3, within: 5 %}",
                           "{probe: p, statistic: at, along: q, where: 0, at_least: 1e-3}"}) {
    Expectation e = expectation(yaml);
    const std::string echo = to_yaml(fields_of(e));
    Expectation again = expectation(echo);
    CHECK(to_yaml(fields_of(again)) == echo);
  }
}

TEST_CASE("a target is met within an absolute or a relative tolerance, ends included") {
  const std::string absolute = "{probe: p, statistic: max, target: 2, within: 0.5}";
  CHECK(judged(absolute, 2.5).pass);
  CHECK(judged(absolute, 1.5).pass);
  CHECK_FALSE(judged(absolute, 2.51).pass);
  CHECK_FALSE(judged(absolute, 1.49).pass);
  const std::string relative = "{probe: p, statistic: min, target: -20, within: 5%}";
  CHECK(judged(relative, -19).pass);
  CHECK(judged(relative, -21).pass);
  CHECK_FALSE(judged(relative, -18.9).pass);
  const std::string exact = "{probe: p, statistic: final, target: 0.1, within: 0}";
  CHECK(judged(exact, 0.1).pass);
  CHECK_FALSE(judged(exact, 0.1 + 1e-17 * 4).pass);
}

TEST_CASE("the result of a target has value, target, tolerance and interval") {
  const ExpectationResult r =
      judged("{name: pull, probe: p, statistic: max, target: 20, within: 10%}", 17);
  CHECK(r.name == "pull");
  CHECK(r.value == 17);
  CHECK(r.target == 20);
  CHECK(r.tolerance == Approx(2));
  CHECK(r.at_least == Approx(18));
  CHECK(r.at_most == Approx(22));
  CHECK_FALSE(r.pass);
  CHECK(r.text == "is 17, expected 20 within 2");
}

TEST_CASE("bounds may be open on one side") {
  const std::string least = "{probe: p, statistic: max, at_least: 2}";
  CHECK(judged(least, 2).pass);
  CHECK(judged(least, 1e300).pass);
  CHECK_FALSE(judged(least, 1.999).pass);
  CHECK(judged(least, 1.5).text == "is 1.5, expected at least 2");
  const std::string most = "{probe: p, statistic: max, at_most: 2}";
  CHECK(judged(most, -5).pass);
  CHECK_FALSE(judged(most, 2.001).pass);
  CHECK(judged(most, 3).text == "is 3, expected at most 2");
  const std::string both = "{probe: p, statistic: max, at_least: 1, at_most: 2}";
  CHECK(judged(both, 1).pass);
  CHECK_FALSE(judged(both, 2.5).pass);
  CHECK_FALSE(judged(both, 0.5).pass);
  CHECK(judged(both, 3).text == "is 3, expected from 1 to 2");
  CHECK(std::isnan(judged(both, 1).target));
  CHECK(std::isnan(judged(both, 1).tolerance));
}

TEST_CASE("an expectation without a finite value fails") {
  const double nan_value = std::numeric_limits<double>::quiet_NaN();
  const double infinity = std::numeric_limits<double>::infinity();
  const std::string least = "{probe: p, statistic: max, at_least: 2}";
  CHECK_FALSE(judged(least, nan_value).pass);
  CHECK_FALSE(judged(least, infinity).pass);
  const ExpectationResult empty =
      judged("{probe: p, statistic: max, over: [5, 6], at_most: 1e9}", 1);
  CHECK_FALSE(empty.pass);
  CHECK(std::isnan(empty.value));
  CHECK(empty.text == "there are no samples, expected at most 1e+09");
  CHECK_FALSE(
      judged("{probe: p, statistic: at, along: time, where: 9, target: 1, within: 1}", 1).pass);
}

TEST_CASE("columns are checked before the run") {
  const Expectation e = expectation("{probe: p, statistic: integral, along: gap, at_least: 0}");
  CHECK_NOTHROW(check_columns(e, {"time", "p", "gap"}));
  CHECK_THROWS_WITH(
      check_columns(e, {"time", "p", "gaps"}),
      "expectation 'p: integral along gap': unknown column 'gap'; did you mean 'gaps'? "
      "(columns: time, p, gaps)");
  CHECK_THROWS_AS(check_columns(e, {"time", "gap"}), InputError);
}

TEST_CASE("numbers of an expectation may have a unit of their column's dimension") {
  const Expectation e = expectation("{probe: p, statistic: at, along: time, where: 20 ms, target: 1.5 kN, within: 5 N}");
  CHECK(double(*e.where) == 0.02);
  CHECK(double(*e.target) == 1500);
  CHECK(tolerance_of(e.within, *e.target) == 5);
  CHECK(double(*expectation("{probe: p, statistic: max, at_least: 30 deg}").at_least) == Approx(0.5235987755982988));
  CHECK(double(*expectation("{probe: p, statistic: max, at_most: 2 g cm^2/ms^2}").at_most) == Approx(2e-7 / 1e-6));
  CHECK(double(*expectation("{probe: p, statistic: max, at_most: 3%}").at_most) == Approx(0.03));
  const Expectation work = expectation("{probe: p, statistic: integral, along: x, at_least: 1 mJ, at_most: 2 mN m}");
  CHECK(double(*work.at_least) == Approx(1e-3));
  CHECK(double(*work.at_most) == Approx(2e-3));
}

TEST_CASE("units of another dimension than the column's are refused before the run") {
  const std::vector<std::string> columns = {"time", "p", "x", "n"};
  const std::vector<Unit> units = {units::time, units::force, units::length, units::none};
  const auto wrong = [&](const std::string& yaml) -> std::string {
    try {
      check_units(expectation(yaml), columns, units);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  CHECK(wrong("{probe: p, statistic: max, target: 1 mN, within: 2 uN}") == "");
  CHECK(wrong("{probe: p, statistic: max, target: 1 mN, within: 2%}") == "");
  CHECK(wrong("{probe: p, statistic: max, target: 5, within: 1}") == "");
  CHECK(wrong("{probe: p, statistic: max, target: 5 mm, within: 1}") ==
        "expectation 'p: max': target: expects a force (N), got '5 mm', which is a length");
  CHECK_THAT(wrong("{probe: p, statistic: max, target: 5 N, within: 1 mm}"), Catch::Contains("': within: expects a force"));
  CHECK_THAT(wrong("{probe: x, statistic: max, at_most: 5 N}"), Catch::Contains("': at_most: expects a length (m)"));
  CHECK_THAT(wrong("{probe: x, statistic: min, at_least: 1 s}"), Catch::Contains("': at_least: expects a length (m)"));
  CHECK_THAT(wrong("{probe: n, statistic: min, at_least: 1 s}"), Catch::Contains("expects a number, got '1 s'"));
  CHECK(wrong("{probe: p, statistic: at, along: x, where: 2 mm, at_least: 1 N}") == "");
  CHECK_THAT(wrong("{probe: p, statistic: at, along: x, where: 2 N, at_least: 1 N}"),
             Catch::Contains("': where: expects a length (m)"));
  CHECK(wrong("{probe: p, statistic: integral, along: x, at_least: 1 mJ}") == "");
  CHECK(wrong("{probe: p, statistic: integral, at_least: 1 N s}") == "");
  CHECK(wrong("{probe: n, statistic: integral, along: x, at_least: 1 mm}") == "");
  CHECK_THAT(wrong("{probe: p, statistic: integral, along: x, at_least: 1 N}"),
             Catch::Contains("at_least: expects an integral (N m), got '1 N', which is a force"));
}

TEST_CASE("an expectation must have exactly one criterion") {
  const auto with = [](const std::string& rest) {
    return bind_error("{probe: p, statistic: max" + rest + "}");
  };
  CHECK_THAT(with(""), Catch::EndsWith("needs target with within, or at_least or at_most"));
  CHECK_THAT(with(", target: 1"), Catch::EndsWith("target needs within, such as 5% or 0.01"));
  CHECK_THAT(with(", within: 1, at_most: 2"), Catch::EndsWith("within needs a target"));
  CHECK_THAT(with(", target: 1, within: 1, at_most: 2"), Catch::EndsWith("not both"));
  CHECK_THAT(with(", at_least: 3, at_most: 2"), Catch::EndsWith("at_least is above at_most"));
  CHECK_THAT(with(", target: 1, within: -5%"), Catch::EndsWith("'-5%' must not be negative"));
  CHECK_THAT(with(", target: 0, within: 5%"), Catch::Contains("a target of 0 is nothing"));
  CHECK_THAT(with(", target: 1, within: close"), Catch::Contains("expects a number with its unit, got 'close'"));
  CHECK_THAT(with(", target: 1, within: [1, 2]"), Catch::Contains("got a list of 2"));
}

TEST_CASE("keys that a statistic does not use are refused") {
  CHECK_THAT(bind_error("{probe: p, at_most: 1}"), Catch::Contains("missing key 'statistic'"));
  CHECK_THAT(bind_error("{statistic: max, at_most: 1}"), Catch::Contains("missing key 'probe'"));
  CHECK_THAT(bind_error("{probe: p, statistic: at, at_most: 1}"),
             Catch::Contains("statistic 'at' needs where"));
  CHECK_THAT(bind_error("{probe: p, statistic: max, where: 1, at_most: 1}"),
             Catch::Contains("only statistic 'at' uses it"));
  CHECK_THAT(bind_error("{probe: p, statistic: max, along: gap, at_most: 1}"),
             Catch::Contains("only the statistics 'integral' and 'at'"));
  CHECK_THAT(bind_error("{probe: p, statistic: max, over: [1], at_most: 1}"),
             Catch::Contains("[t0, t1]"));
  CHECK_THAT(bind_error("{probe: p, statistic: max, over: [2, 1], at_most: 1}"),
             Catch::Contains("t0 not above t1"));
  CHECK_THAT(bind_error("{probe: p, statistic: meen, at_most: 1}"),
             Catch::Contains("did you mean 'mean'"));
}

namespace {

class Measured {
 public:
  explicit Measured(const std::string& text) { write_file(path(), text); }
  std::string path() const { return (folder_.path() / "load.csv").string(); }
  // p over q of a run: 0 at 0, 10 at 1, 0 at 3.
  ExpectationResult judged(const std::string& statistic, const std::string& more = "") const {
    const ProbeSeries run{{"time", "q", "p"}, {{0, 0, 0}, {1, 1, 10}, {2, 3, 0}}};
    return evaluate(specified(statistic, more), run);
  }
  Expectation specified(const std::string& statistic, const std::string& more = "") const {
    return expectation("{name: n, probe: p, statistic: " + statistic + ", along: q, at_most: 10%, follows: {file: " + path() + more + "}}");
  }
  void remove() const { std::filesystem::remove(path()); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("a run is compared with a measured curve") {
  const Measured file("q [mm], p [N]\n500, 5\n1000, 8\n2000, 5\n");
  const ExpectationResult mean = file.judged("deviation");
  CHECK(mean.value == Approx(0.25 / 3));
  CHECK(mean.pass);
  CHECK(mean.text == "is 0.0833333 (3 points, on average +8.33%, worst 25.00% at q = 1), expected at most 0.1");
  CHECK(file.judged("rms_deviation").value == Approx(0.25 / std::sqrt(3)));
  const ExpectationResult worst = file.judged("worst_deviation");
  CHECK(worst.value == Approx(0.25));
  CHECK_FALSE(worst.pass);
  CHECK(file.judged("deviation", ", from: 1.5").value == 0);
  CHECK(name_of(expectation("{probe: p, statistic: deviation, along: q, at_most: 1, follows: {file: /a/load.csv}}")) == "p: deviation from load.csv along q");
}

TEST_CASE("unreached points and missing files of measured data fail the expectation") {
  const Measured beyond("q [mm], p [N]\n500, 5\n3100, 0\n");
  CHECK_FALSE(beyond.judged("deviation").pass);
  CHECK_THAT(beyond.judged("deviation").text, Catch::Contains("does not pass 1 of 2 measured points, the first at") && Catch::Contains("load.csv:3 (q = 3.1): q goes from 0 to 3"));
  const Measured zero("q [mm], p [N]\n2500, 0\n500, 5\n");
  CHECK_THAT(zero.judged("deviation").text, Catch::Contains("load.csv:2 is 0") && Catch::Contains("relative_to: peak"));
  CHECK(zero.judged("deviation", ", relative_to: peak").value == Approx(0.25));
  zero.remove();
  CHECK_FALSE(zero.judged("deviation").pass);
  CHECK_THAT(zero.judged("deviation").text, Catch::Contains("load.csv"));
}

TEST_CASE("measured data are checked before a run") {
  const std::vector<std::string> columns = {"time", "q", "p"};
  const std::vector<Unit> units = {units::time, units::length, units::force};
  const auto error = [&](const Measured& file, const std::string& more = "") -> std::string {
    try {
      check_columns(file.specified("deviation", more), columns);
      check_units(file.specified("deviation", more), columns, units);
    } catch (const InputError& e) {
      return e.what();
    }
    return "";
  };
  CHECK(error(Measured("q [mm], p [mN]\n5, 5\n"), ", from: 1 mm") == "");
  CHECK_THAT(error(Measured("q [s], p [mN]\n5, 5\n")), Catch::Contains("expectation 'n': follows: ") && Catch::Contains("column 'q': expects a length"));
  CHECK_THAT(error(Measured("q [mm], p [mN]\n5, 5\n"), ", from: 1 N"), Catch::Contains("expectation 'n': from: "));
  const Measured gone("");
  gone.remove();
  CHECK_THAT(error(gone), Catch::Contains("load.csv"));
  CHECK_THAT(bind_error("{probe: p, statistic: deviation, at_most: 1}"), Catch::Contains("needs follows"));
  CHECK_THAT(bind_error("{probe: p, statistic: max, at_most: 1, follows: {file: a.csv}}"), Catch::Contains("only 'deviation'"));
}
