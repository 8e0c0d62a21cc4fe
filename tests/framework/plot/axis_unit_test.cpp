// Units of axes with prefixes, and units in legends.
#include "framework/plot/axis_unit.hpp"

#include <catch2/catch.hpp>

#include "framework/plot/gnuplot.hpp"
#include "framework/plot/table_plots.hpp"
#include "tests/support/program.hpp"

using namespace tack;

TEST_CASE("the prefix of an axis suits its largest number", "[plot]") {
  const auto text = [](double largest, const std::string& unit) { return axis_unit(largest, unit).text; };
  CHECK(text(3e-3, "m") == "mm");
  CHECK(axis_unit(3e-3, "m").factor == Approx(1e3));
  CHECK(text(0.4, "m") == "m");
  CHECK(text(2e-6, "J") == "µJ");
  CHECK(text(2e5, "Pa") == "kPa");
  CHECK(text(7e3, "s") == "s");
  CHECK(text(5, "N") == "N");
  CHECK(text(2e-5, "1") == "10⁻⁶");
  CHECK(text(2.5e6, "kg/m^3") == "10⁶ kg/m³");
  CHECK(text(1500, "kg/m^3") == "kg/m³");
  CHECK(text(0, "m") == "m");
  CHECK(with_axis_unit(5000, "Pa") == "5 kPa");
  CHECK(with_axis_unit(0.3, "") == "0.3");
}

TEST_CASE("the table of a batch is drawn with the units of its columns", "[plot]") {
  const CsvTexts table{{"case", "young", "strength", "pull_off"},
                       {{"a", "100000", "2000", "0.001"}, {"b", "200000", "2000", "0.003"}, {"c", "100000", "500", "0.002"}, {"d", "200000", "500", "0.004"}}};
  const Plot plot = table_plot(table, {"young", "pull_off", {"strength"}}, {{"young", "Pa"}, {"strength", "Pa"}, {"pull_off", "m"}});
  REQUIRE(plot.curves.size() == 2);
  CHECK(plot.curves[0].title == "strength 2 kPa");
  CHECK(plot.curves[1].title == "strength 500 Pa");
  const TemporaryFolder folder;
  draw(plot, folder.path(), "plot");
  const std::string script = file_text(folder.path() / "plot.gp");
  CHECK(contains(script, "set xlabel 'young [kPa]'"));
  CHECK(contains(script, "set ylabel 'pull_off [mm]'"));
  CHECK(contains(script, "\n100 1 1 1\n"));
  CHECK(contains(script, "\n200 4 4 4\n"));
}
