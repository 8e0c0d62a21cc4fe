#include "framework/plot/plot.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <set>

#include "framework/plot/gnuplot.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

TEST_CASE("axes end at the data", "[plot]") {
  const auto linear = range_of({3, 5, NAN, INFINITY}, false);
  REQUIRE(linear);
  CHECK(linear->low == Approx(2.9));
  CHECK(linear->high == Approx(5.1));
  const auto log = range_of({3, 40, -1, 0}, true);
  REQUIRE(log);
  CHECK(log->low > 2.5);
  CHECK(log->high < 50);  // no whole decades
  CHECK(log->position(3) == Approx(1 / 22.0).margin(1e-3));
  CHECK_FALSE(range_of({-1, NAN}, true));
  CHECK(range_of({4}, true)->low == 2);
  CHECK(range_of({0}, false)->high > 0);
}

TEST_CASE("a logarithmic axis always has ticks", "[plot]") {
  CHECK(log_ticks({2.5, 47, true}) == std::vector<double>{5, 10, 20});
  CHECK(log_ticks({0.9, 1100, true}) == std::vector<double>{1, 10, 100, 1000});
  CHECK(log_ticks({1e-17, 1, true}).size() < 12);
  for (const double factor : {2.6, 7.0, 30.0, 1e3, 1e12}) CHECK(log_ticks({3e-4, 3e-4 * factor, true}).size() >= 1);
}

TEST_CASE("a curve that leaves the range of x is broken there", "[plot]") {
  Plot plot;
  plot.curves = {{"loaded and unloaded", {{0, 0}, {1, 1}, {2, 3}, {1.5, 2}, {0.5, 0.2}, {0, 0}}, {}}};
  const auto& points = within(plot, 0, 1).curves.at(0).points;
  REQUIRE(points.size() == 5);
  CHECK(points[1] == std::pair(1.0, 1.0));
  CHECK(std::isnan(points[2].first));
  CHECK(points[3] == std::pair(0.5, 0.2));
  CHECK(within(plot, 1.8, 3).curves.at(0).points.size() == 1);  // none at its ends
}

TEST_CASE("equal curves are merged, with both names", "[plot]") {
  const auto merged = merged_curves({{"a", {{1, 2}}, {}}, {"b", {{1, 3}}, {}}, {"c", {{1, 2}}, {}}, {"d", {}, {}}, {"e", {}, {}}});
  REQUIRE(merged.size() == 4);
  CHECK(merged[0].title == "a, c");
  CHECK(merged[2].title == "d");
  // Also where a range breaks them.
  Plot left;
  left.curves = {{"a", {{0, 1}, {9, 2}, {1, 3}}, {}}, {"b", {{0, 1}, {9, 2}, {1, 3}}, {}}};
  CHECK(merged_curves(within(left, 0, 2).curves).size() == 1);
}

TEST_CASE("labels stand near their curves without overlapping", "[plot]") {
  CHECK(*separate_labels({0.2, 0.8}, 0.1) == std::vector<double>{0.2, 0.8});
  const auto close = *separate_labels({0.5, 0.5, 0.52}, 0.1);
  CHECK(close[0] == Approx(0.4067).margin(1e-3));
  CHECK(close[1] == Approx(close[0] + 0.1));
  CHECK(close[2] == Approx(close[1] + 0.1));
  const auto top = *separate_labels({1, 1, 0.99}, 0.1);
  CHECK(top[0] == Approx(0.9));
  CHECK(top[1] == Approx(1));
  CHECK(top[2] == Approx(0.8));
  CHECK_FALSE(separate_labels(std::vector<double>(20, 0.5), 0.1));
  const auto many = *separate_labels({0, 0.01, 0.02, 0.9, 0.91, 0.5}, 0.1);
  for (size_t i = 0; i < many.size(); ++i)
    for (size_t k = 0; k < i; ++k) CHECK(std::abs(many[i] - many[k]) > 0.1 - 1e-9);
}

TEST_CASE("28 curves differ in colour or dash", "[plot]") {
  const TemporaryFolder folder;
  Plot plot;
  plot.title = "many";
  plot.notes = {"a note", "another"};
  for (int i = 0; i < 28; ++i) plot.curves.push_back({"curve " + std::to_string(i), {{0, i}, {1, 2 * i + 1}}, {}});
  const std::string failure = draw(plot, folder.path(), "plot");
  const std::string script = file_text(folder.path() / "plot.gp");
  std::set<std::string> styles;
  for (size_t at = script.find("using 1:2 with"); at != script.npos; at = script.find("using 1:2 with", at + 1)) {
    const size_t colour = script.find("lc rgb", at), width = script.find(" lw", colour);
    styles.insert(script.substr(colour, width - colour));
  }
  CHECK(styles.size() == 28);
  CHECK(contains(script, "left top Left reverse"));  // no room for their names at their ends
  if (!contains(failure, "gnuplot is missing")) CHECK(failure == "");
}

TEST_CASE("few curves have labels at their ends", "[plot]") {
  const TemporaryFolder folder;
  Plot plot;
  plot.title = "few";
  plot.curves = {{"first", {{0, 1}, {1, 2}}, {}}, {"second", {{0, 1}, {1, 2.01}}, {}}};
  draw(plot, folder.path(), "plot");
  CHECK(contains(file_text(folder.path() / "plot.gp"), "set label 'second' at graph 1.015"));
  plot.curves.push_back({"short", {{0, 1}, {0.2, 1.5}}, {}});
  draw(plot, folder.path(), "plot");
  CHECK(contains(file_text(folder.path() / "plot.gp"), "set key outside"));
}
