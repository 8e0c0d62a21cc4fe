// A minimiser is one file: tests/support/heavy_ball.cpp is all that makes `type: heavy_ball` known to
// scenes, listings and the schema.
#include <catch2/catch.hpp>

#include "framework/config/describe.hpp"
#include "framework/scene/scene_config.hpp"
#include "tests/support/program.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;

TEST_CASE("the minimizer's file fits on a page", "[minimizer]") {
  const std::string file = file_text(TACK_SOURCE_DIR "/tests/support/heavy_ball.cpp");
  CHECK(std::count(file.begin(), file.end(), '\n') <= 60);
}

TEST_CASE("a minimizer is listed, documented and in the schema because it exists", "[minimizer]") {
  CHECK(contains(list_kind("minimizer"), "heavy_ball"));
  CHECK(contains(list_component("minimizer", "heavy_ball"), "file: tests/support/heavy_ball.cpp"));
  CHECK(contains(reference_page(prototype<Experiment>(), "Scene"), "### minimizer `heavy_ball`"));
  CHECK(contains(json_schema(prototype<Experiment>(), "scene"), "\"heavy_ball\""));
}

TEST_CASE("a scene that names the minimizer is solved by it", "[minimizer]") {
  TestRun simulation(tiny_scene.substr(tiny_scene.find('\n') + 1) + "solver: {type: heavy_ball, momentum: 0.2}\n");
  while (!simulation.stepper.finished()) CHECK(simulation.step().converged);
  CHECK(simulation.warnings.empty());
}
