#include "framework/output/summary.hpp"

#include <catch2/catch.hpp>
#include <limits>

#include "geometry/errors.hpp"
#include "tests/support/json.hpp"
#include "tests/support/silence.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

constexpr double nan_value = std::numeric_limits<double>::quiet_NaN();
constexpr double infinity = std::numeric_limits<double>::infinity();

RunSummary filled() {
  RunSummary s;
  s.name = "tape \"x\"";
  s.provenance.build.version = "1.2.3";
  s.provenance.build.commit = "abc";
  s.provenance.build.untracked_sources = 1;
  s.provenance.threads = 2;
  s.status = RunStatus::expectation_failed;
  s.error = "why";
  s.dofs = 300;
  s.wall_seconds = 0.1 + 0.2;
  s.phases[static_cast<int>(Phase::assembly)] = 3;
  s.phases[static_cast<int>(Phase::solve)] = 1;
  s.inverted_tets = 4;
  s.flows.amount("dissipated_friction") = 0.75;
  s.energy_gains = 2;
  s.adhesion = {{{"tape", "desk"}, 1, {{0, 1}}, -1, 0.5, 0.4, 1e-4, 1e3}};
  s.expect = {{"a", 1, 2, 0.5, 1.5, 2.5, false, "is 1, expected 2 within 0.5"},
              {"b", nan_value, nan_value, nan_value, -infinity, 3, false, "no samples"}};
  return s;
}

nlohmann::json written(const RunSummary& summary) {
  const TemporaryFolder folder;
  write_summary(folder.path() / "summary.json", summary);
  return read_json(folder.path() / "summary.json");
}

StepReport report(bool converged, int contacts, double distance) {
  StepReport r;
  r.converged = converged;
  r.unbalanced_force = contacts;
  r.rejections[Rejection::solve] = 2;
  r.solve = {MinimizerStatus::converged, 3, 4, 9, 5, 0.1};
  r.contacts = contacts;
  r.min_distance = distance;
  r.broad_phase_builds = 1;
  r.intersections = 1;
  return r;
}

}  // namespace

TEST_CASE("summary.json holds the run") {
  const nlohmann::json json = written(filled());
  CHECK(json["name"] == "tape \"x\"");
  CHECK(json["version"] == "1.2.3");
  CHECK(json["commit"] == "abc-dirty");
  CHECK(json["provenance"]["commit"] == "abc");
  CHECK(json["status"] == "expectation failed");
  CHECK(json["error"] == "why");
  CHECK(json["threads"] == 2);
  CHECK(json["dofs"] == 300);
  CHECK(json["wall_seconds"].get<double>() == 0.1 + 0.2);
  CHECK(json["phases"].size() == std::size_t(phase_count));
  CHECK(json["phases"]["assembly"] == 3.0);
  CHECK(json["phases"]["line_search"] == 0.0);
  CHECK(json["inverted_tets"] == 4);
  CHECK(json["energy"]["dissipated_friction"] == 0.75);
  CHECK(json["energy"]["gains"] == 2);
  const nlohmann::json adhesion = {{"between", {"tape", "desk"}},
                                   {"work_of_adhesion", 0.5},
                                   {"effective", 0.4},
                                   {"rest_gap", 1e-4},
                                   {"peak_traction", 1e3}};
  CHECK(json["adhesion"] == nlohmann::json::array({adhesion}));
}

TEST_CASE("summary.json has exactly the documented keys") {
  const nlohmann::json json = written({});
  std::vector<std::string> keys;
  for (const auto& [key, value] : json.items()) keys.push_back(key);
  CHECK(keys == std::vector<std::string>{"adhesion", "commit", "converged_steps", "dofs", "energy", "error",
                                         "expect", "failed_solves", "intersections",
                                         "inverted_tets", "linear_solver", "lowest_quality", "max_affine_strain",
                                         "max_contacts", "max_unbalanced_force", "meeting_groups", "min_distance", "min_gap", "name",
                                         "phases", "provenance", "remeshings", "repeated_steps", "status", "step_size", "stepper", "steps", "stiffness", "threads", "totals",
                                         "unbalanced_steps", "unconverged_lags", "version", "wall_seconds", "warnings"});
  CHECK(json["expect"] == nlohmann::json::array());
  CHECK(json["min_distance"].is_null());  // nothing was ever near
}

TEST_CASE("summary.json holds the expectations, without a number as null") {
  const nlohmann::json expect = written(filled())["expect"];
  REQUIRE(expect.size() == 2);
  CHECK(expect[0] == nlohmann::json({{"name", "a"},
                                     {"value", 1.0},
                                     {"target", 2.0},
                                     {"tolerance", 0.5},
                                     {"at_least", 1.5},
                                     {"at_most", 2.5},
                                     {"pass", false},
                                     {"text", "is 1, expected 2 within 0.5"}}));
  CHECK(expect[1]["value"].is_null());
  CHECK(expect[1]["target"].is_null());
  CHECK(expect[1]["at_least"].is_null());
  CHECK(expect[1]["at_most"] == 3.0);
}

TEST_CASE("a summary adds up its steps") {
  RunSummary s;
  s.add(report(true, 5, 0.2));
  s.add(report(false, 9, infinity));
  StepReport unlagged = report(true, 7, 0.1);
  unlagged.lag_converged = false;
  s.add(unlagged);
  const nlohmann::json json = written(s);
  CHECK(json["steps"] == 3);
  CHECK(json["converged_steps"] == 2);
  CHECK(json["failed_solves"] == 6);
  CHECK(json["unconverged_lags"] == 1);
  CHECK(json["totals"] == nlohmann::json({{"newton_iterations", 9},
                                          {"linear_solves", 12},
                                          {"linear_iterations", 27},
                                          {"line_search_evaluations", 15},
                                          {"broad_phase_builds", 3}}));
  CHECK(json["max_contacts"] == 9);
  CHECK(json["max_unbalanced_force"] == 9.0);
  CHECK(json["unbalanced_steps"] == 2);  // the one that did not converge is not counted twice
  CHECK(json["min_distance"] == 0.1);
  CHECK(json["intersections"] == 3);
}

TEST_CASE("a summary has the first warning of each kind with its count") {
  RunSummary s;
  CHECK(s.add({WarningKind::coarse_adhesion, "coarse"}));
  CHECK(s.add({WarningKind::step_cutback, "step 3: rolled back"}));
  CHECK_FALSE(s.add({WarningKind::step_cutback, "step 4: rolled back"}));
  CHECK(s.add({WarningKind::coarse_adhesion, "thin"}));
  CHECK_FALSE(s.add({WarningKind::coarse_adhesion, "coarse"}));  // told again by a run that goes on
  CHECK(s.add({WarningKind::joint_play, "step 5: a by 1 mm", "a"}));
  CHECK(s.add({WarningKind::joint_play, "step 5: b by 2 mm", "b"}));
  CHECK_FALSE(s.add({WarningKind::joint_play, "step 6: b by 3 mm", "b"}));
  CHECK(written(s)["warnings"] == nlohmann::json::array({{{"kind", "coarse_adhesion"}, {"text", "coarse"}, {"times", 1}},
                                                         {{"kind", "step_cutback"}, {"text", "step 3: rolled back"}, {"times", 2}},
                                                         {{"kind", "coarse_adhesion"}, {"text", "thin"}, {"times", 1}},
                                                         {{"kind", "joint_play"}, {"text", "step 5: a by 1 mm"}, {"times", 1}},
                                                         {{"kind", "joint_play"}, {"text", "step 5: b by 2 mm"}, {"times", 2}}}));
}

TEST_CASE("every status has a text") {
  CHECK(to_string(RunStatus::done) == "done");
  CHECK(to_string(RunStatus::expectation_failed) == "expectation failed");
  CHECK(to_string(RunStatus::simulation_failed) == "simulation failed");
  CHECK(to_string(RunStatus::interrupted) == "interrupted");
}

TEST_CASE("text that is not UTF-8 does not prevent the summary") {
  RunSummary s;
  s.error = "bad \xff byte";
  CHECK(written(s)["error"] == "bad \xEF\xBF\xBD byte");
}

TEST_CASE("a summary that cannot be written is an error") {
  CHECK_THROWS_AS(write_summary("/nonexistent/summary.json", {}), InputError);
}

TEST_CASE("the phase table shows percentages, longest phase first") {
  CHECK(phase_table(filled()) ==
        "phase            seconds      %\n"
        "assembly           3.000   75.0  ##############################\n"
        "solve              1.000   25.0  ##########\n"
        "total              4.000\n");
  CHECK(phase_table({}) ==
        "phase            seconds      %\n"
        "total              0.000\n");
}

TEST_CASE("the table of expectations") {
  std::vector<ExpectationResult> results = filled().expect;
  results[0].name = "longer";
  results[0].pass = true;
  CHECK(expect_table(results) ==
        "pass  longer  is 1, expected 2 within 0.5\n"
        "FAIL  b       no samples\n");
  CHECK(expect_table({}) == "");
}
