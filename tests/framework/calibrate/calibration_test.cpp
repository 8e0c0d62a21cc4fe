#include "framework/calibrate/calibration.hpp"

#include <catch2/catch.hpp>

#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;

TEST_CASE("a calibration warns of missing derivatives, missed points and failed runs", "[calibrate]") {
  SearchResult search;
  search.rows.resize(3);
  search.rows[0].evaluation.good = search.rows[1].evaluation.good = true;
  search.best.beyond = {0, 2};
  search.derivatives.problem = "the runs beside the best one failed";
  std::vector<MeasuredPoints> measured(2);
  measured[1].curve.path = "pull.csv";
  const std::vector<Warning> warnings = warnings_about(search, measured);
  CHECK(warnings.size() == 3);
  CHECK_THAT(first_text(warnings, WarningKind::no_intervals), Contains("the runs beside the best one failed"));
  CHECK_THAT(first_text(warnings, WarningKind::missed_points), Contains("2 of 0 points of pull.csv"));
  CHECK_THAT(first_text(warnings, WarningKind::failed_points), Contains("1 of 3 "));
  // Most points are out of reach, as with millimetres in a column without a unit.
  measured[1].curve.x = {0, 0.2, 0.6};
  CHECK_THAT(first_text(warnings_about(search, measured), WarningKind::missed_points), Contains("they go from 0 to 0.6 in SI: check the unit and the sign"));
}

TEST_CASE("a calibration that found everything is silent", "[calibrate]") {
  SearchResult search;
  search.rows.resize(1);
  search.rows[0].evaluation.good = true;
  search.best.beyond = {0};
  CHECK(warnings_about(search, std::vector<MeasuredPoints>(1)) == std::vector<Warning>{});
}
