// The same scene gives the same bits: run after run, and for any number of threads.
#include <catch2/catch.hpp>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

std::string run_with_threads(const fs::path& folder, const std::string& scene, const char* threads) {
  static int runs = 0;
  const std::string name = "run" + std::to_string(++runs);
  const ProgramResult result =
      run_tack(folder, {"run", scene, "-q", "--threads", threads, "-o", name});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  const auto summary = read_json(folder / name / "summary.json");
  CHECK(std::to_string(summary["threads"].get<int>()) == threads);
  std::string all = file_text(folder / name / "probes.csv");
  REQUIRE_FALSE(all.empty());
  for (int i = 0; i < 6; ++i) {
    const std::string frame = file_text(folder / name / "frames" / ("frame_00000" + std::to_string(i) + ".vtu"));
    REQUIRE_FALSE(frame.empty());
    all += frame;
  }
  return all;
}

}  // namespace

// The sticky floor becomes a plate that is driven ten contact distances into the block, every step.
TEST_CASE("a scripted surface pushes with the same bits for any number of threads") {
  const TemporaryFolder folder;
  std::string scene = tiny_scene_with("size: [0.2, 0.2, 0.2]}", "size: [0.2, 0.2, 0.2], cells: [7, 4, 7]}");
  const std::string fixed = "motion: [fixed]";
  scene.replace(scene.find(fixed), fixed.size(), "motion: [{type: translate, velocity: [0.1, 1, 0]}]");
  write_file(folder.path() / "scene.yaml", scene);
  const std::string one = run_with_threads(folder.path(), "scene.yaml", "1");
  CHECK(run_with_threads(folder.path(), "scene.yaml", "2") == one);
}

TEST_CASE("probes and frames do not depend on the run or on the number of threads") {
  const TemporaryFolder folder;
  // Large enough for several chunks of every parallel loop; askew, so that every kind of pair occurs.
  std::string scene = tiny_scene_with("size: [0.2, 0.2, 0.2]}",
                                      "size: [0.2, 0.2, 0.2], cells: [7, 4, 7]}\n"
                                      "    velocity: [0.1, -0.2, 0.3]");
  const std::string adhesion = "critical_strain: 0.001}\n";
  scene.insert(scene.find(adhesion) + adhesion.size(),
               "      friction: {mu: 0.4}\n      tangential_adhesion: {mu: 1, eps_a: 10 mm/s}\n");
  write_file(folder.path() / "scene.yaml", scene);
  const std::string one = run_with_threads(folder.path(), "scene.yaml", "1");
  CHECK(contains(one, "friction_force"));
  CHECK(run_with_threads(folder.path(), "scene.yaml", "1") == one);
  CHECK(run_with_threads(folder.path(), "scene.yaml", "2") == one);
  CHECK(run_with_threads(folder.path(), "scene.yaml", "4") == one);
}
