// Remarks appear above their thresholds only.
#include <catch2/catch.hpp>

#include "framework/profile/profile.hpp"

using namespace tack;
using Catch::Contains;

namespace {

double& phase_of(Profile& p, Phase phase) { return p.phases[static_cast<int>(phase)]; }

// Ten seconds, of which contact takes none.
Profile quiet() {
  Profile p;
  p.steps = 100;
  p.iterations = 200;
  p.line_search_evaluations = 200;
  p.lag_iterations = 100;
  p.linear = {"pcg", 200, 2000, 200, true};
  p.cuts = {200, 0, 0};
  phase_of(p, Phase::assembly) = 10;
  return p;
}

PairCost pair_of(const std::string& a, const std::string& b, double seconds, int touching_steps) {
  PairCost pair{a, b, {}, touching_steps, {}};
  pair.seconds.narrow_phase = seconds;
  return pair;
}

}  // namespace

TEST_CASE("a run in which nothing stands out gets no remarks") { CHECK(remarks_on(quiet()).empty()); }

TEST_CASE("the pair that dominates contact is named, if it never touches") {
  Profile p = quiet();
  p.pairs = {pair_of("mat", "mat", 3, 0), pair_of("floor", "mat", 0.5, 80)};
  const auto remarks = remarks_on(p);
  REQUIRE(remarks.size() == 1);
  CHECK_THAT(remarks[0], Contains("86% of contact's time is 'mat' with itself") &&
                             Contains("between: [mat, mat], contact: false"));
  p.pairs[0].touching_steps = 1;
  CHECK(remarks_on(p).empty());
  p.pairs[0] = pair_of("mat", "wall", 3, 0);
  CHECK_THAT(remarks_on(p).at(0), Contains("'mat' and 'wall'"));
}

TEST_CASE("idle pairs are counted together") {
  Profile p = quiet();
  for (int i = 0; i < 10; ++i) p.pairs.push_back(pair_of("a" + std::to_string(i), i < 4 ? "a" + std::to_string(i) : "b", 0.11, 0));
  REQUIRE(remarks_on(p).size() == 1);
  CHECK_THAT(remarks_on(p)[0], Contains("did not touch (10, 4 of them objects with themselves)") && Contains("[a0, a0]"));
  for (PairCost& pair : p.pairs) pair.seconds.narrow_phase = 0.09;
  CHECK(remarks_on(p).empty());
}

TEST_CASE("a range of many edges is remarked on where contact is expensive") {
  Profile p = quiet();
  p.contact_ranges = {{"mat", 1e-3, 8e-3}};
  CHECK(remarks_on(p).empty());
  p.pairs = {pair_of("floor", "mat", 3, 100)};
  CHECK_THAT(remarks_on(p).at(0), Contains("8 edges of 'mat'") && Contains("`contact.distance`"));
}

TEST_CASE("the linear solver's remark depends on the scene's choice and on its iterations") {
  Profile p = quiet();
  phase_of(p, Phase::solve) = 9.9;
  CHECK(remarks_on(p).empty());
  phase_of(p, Phase::solve) = 10.1;
  CHECK_THAT(remarks_on(p).at(0), Contains("50% of the run") && Contains("`shape.cells`"));
  p.linear.iterations = 6000;
  CHECK_THAT(remarks_on(p).at(0), Contains("newton_pcg"));
  p.linear.automatic = false;
  CHECK_THAT(remarks_on(p).at(0), Contains("`solver.linear: auto`"));
}

TEST_CASE("where steps are cut, how near surfaces came tells whether the barrier is soft or stiff for them") {
  Profile p = quiet();
  p.cuts = {200, 50, 10};
  const auto remark = [&](double nearness, long iterations) {
    p.nearness = {10, 10 * nearness};
    p.iterations = p.line_search_evaluations = iterations;
    return remarks_on(p).at(0);
  };
  const std::string barrier_key = "`contact.barrier.stiffness`";
  CHECK_THAT(remark(0.004, 200), Contains("0.004 of `contact.distance` apart") && Contains("ten times the " + barrier_key));
  CHECK_THAT(remark(0.36, 9000), Contains("in 90 iterations each") && Contains("a tenth of the " + barrier_key));
  CHECK_THAT(remark(0.36, 2000), Contains("a smaller `time.step`") && !Contains(barrier_key));
  CHECK_THAT(remark(0.1, 9000), Contains("a smaller `time.step`") && !Contains(barrier_key));
  p.nearness = {};
  CHECK_THAT(remarks_on(p).at(0), Contains("a smaller `time.step`"));
}

TEST_CASE("the five most expensive remarks are printed, in order") {
  Profile p = quiet();
  phase_of(p, Phase::assembly) = 0;
  phase_of(p, Phase::solve) = 50;
  phase_of(p, Phase::io) = 30;
  phase_of(p, Phase::broad_phase) = 20;
  p.searches = 150;
  p.failed_solves = 2;
  p.cuts = {200, 50, 10};
  p.line_search_evaluations = 400;
  p.lag_iterations = 400;
  const auto remarks = remarks_on(p);
  REQUIRE(remarks.size() == 5);
  CHECK_THAT(remarks[0], Contains("4 times for friction"));
  CHECK_THAT(remarks[1], Contains("linear systems take 50%"));
  CHECK_THAT(remarks[2], Contains("`output.frame_interval`"));
  CHECK_THAT(remarks[3], Contains("cut 25% of 200 Newton steps, to 0.2 "));
  CHECK_THAT(remarks[4], Contains("searched 150 times in 200 iterations"));
}
