#include "framework/compare/compare_config.hpp"

#include <catch2/catch.hpp>
#include <filesystem>

#include "framework/compare/comparison.hpp"
#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "geometry/errors.hpp"

using namespace tack;

TEST_CASE("every shipped comparison file is valid", "[compare]") {
  int files = 0;
  for (const auto& entry : std::filesystem::directory_iterator(TACK_SOURCE_DIR "/experiments/compare")) {
    INFO(entry.path());
    const CompareConfig config = load_comparison(entry.path().string(), {});
    const std::vector<CompareCase> cases = cases_of(config);
    CHECK(cases.size() == config.problems.size() + config.bases.size() + (config.base.empty() ? 0 : 1));
    for (const CompareCase& c : cases) CHECK(c.size > 0);
    ++files;
  }
  CHECK(files >= 4);
}

TEST_CASE("the time of an entry overrides the scene's: adaptive steps reach the same end in fewer steps", "[compare]") {
  const CompareCase pull = experiment_case(TACK_SOURCE_DIR "/experiments/debonding/pull.yaml",
                                           {"objects.upper.shape.cells=[3, 1, 3]", "objects.lower.shape.cells=[4, 1, 4]"}, 100);
  Trial fixed(pull, {Value(), 1e-4, 1e-3});
  Trial adaptive(pull, {Value(), 1e-4, 1e-3, Value(), parse_string("adaptive: {error: 1 um}\n", "test.yaml")});
  REQUIRE(fixed.run().converged);
  REQUIRE(adaptive.run().converged);
  CHECK(fixed.result().steps == 100);
  CHECK(adaptive.result().steps < 70);
  CHECK(largest_distance(fixed.world(), fixed.result().x, adaptive.result().x) < 20e-6);
}

TEST_CASE("the time of an entry may have its own step, but no end and no stepper", "[compare]") {
  const auto entry = [](const std::string& time) {
    SolverEntry e;
    bind(parse_string("{name: a, time: " + time + "}", "test.yaml"), e, "an entry");
    return e;
  };
  CHECK(entry("{step: 2 ms, adaptive: {error: 1 mm}}").own_step() == 2e-3);
  CHECK_FALSE(entry("{integrator: bdf2}").own_step());
  CHECK_THROWS_AS(entry("{duration: 1 s}"), InputError);
  CHECK_THROWS_AS(entry("{stepper: lcp_pgs}"), InputError);
}
