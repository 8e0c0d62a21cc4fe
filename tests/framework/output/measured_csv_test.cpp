#include "framework/output/measured_csv.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "tests/support/program.hpp"

using namespace tack;

TEST_CASE("measured.csv compares with the samples of the expectation's stage", "[measured]") {
  // The gap of 1 is passed in both stages, with another force each time.
  const TemporaryFolder folder;
  write_file(folder.path() / "pull.csv", "gap,force\n1,5\n");
  const ProbeSeries series{{"time", "gap", "force"}, {{0, 2, 0}, {1, 0, 4}, {2, 2, 12}}};
  const std::vector<StageVisit> stages = {{"press", "approach", 1, 0, 1, "", 0, 0}, {"press", "retract", 2, 1, 2, "", 0, 0}};
  const auto computed = [&](const std::string& stage) {
    Expectation e;
    e.query.probe = "force";
    e.query.along = "gap";
    e.query.statistic = Statistic::deviation;
    e.query.follows.emplace();
    e.query.follows->file = (folder.path() / "pull.csv").string();
    e.stage = stage;
    std::vector<Expectation> all;
    all.push_back(std::move(e));
    write_measured(folder.path() / "measured.csv", all, series, stages);
    return csv_number(read_csv_texts(folder.path() / "measured.csv").rows.at(0).at(4)).value();
  };
  CHECK(windows_of_stage({{"a", "pull", 1, 2, 3, "", 0, 0}, {"a", "other", 2, 0, 9, "", 0, 0}, {"b", "pull", 1, 0, 1, "", 0, 0}, {"b", "pull", 2, 2.5, 4, "", 0, 0}, {"b", "pull", 2, std::nan(""), 9, "", 0, 0}}, "pull").size() == 2);
  CHECK(computed("approach") == Approx(2));
  CHECK(computed("retract") == Approx(8));
  CHECK(computed("") == Approx(2));
}
