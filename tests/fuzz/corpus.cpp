#include "tests/fuzz/corpus.hpp"

#include <algorithm>
#include <stdexcept>

#include "geometry/shapes/solids.hpp"
#include "geometry/shapes/surfaces.hpp"
#include "tests/fuzz/forked_run.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "geometry/io/write_mesh.hpp"

namespace tack {
namespace {

namespace fs = std::filesystem;

// A block falls on the mesh, which does not move.
std::string scene_on(const fs::path& mesh) {
  return tiny_scene_with("{type: box, size: [1, 0.2, 1]}", "{type: file, path: \"" + mesh.string() + "\"}");
}

std::vector<Sample> meshes(const fs::path& scratch) {
  fs::copy(TACK_TEST_DATA "/meshes", scratch / "meshes");
  for (const char* name : {"box.msh", "box.vtu"}) write_mesh(scratch / "meshes" / name, box_tets({1, 0.2, 1}, {2, 1, 2}));
  write_mesh(scratch / "meshes/box.obj", box_surface({1, 0.2, 1}, {2, 1, 2}));
  std::vector<Sample> samples;
  for (const auto& entry : fs::directory_iterator(scratch / "meshes")) {
    const fs::path scene = scratch / (entry.path().filename().string() + ".yaml");
    write_file(scene, scene_on(entry.path()));
    samples.push_back({entry.path(), file_text(entry.path()),
                       {{"mesh", "info", entry.path()}, {"mesh", "info", entry.path()}, {"check", scene}}, scratch});
  }
  return samples;
}

// All experiments but comparisons, batches and the hard ones, which are many of a kind, and large files, whose checks take long; the two smallest are run for two steps as well.
std::vector<Sample> scenes(const fs::path& scratch) {
  fs::copy(TACK_SOURCE_DIR "/experiments", scratch / "experiments", fs::copy_options::recursive);
  std::vector<Sample> samples;
  for (const auto& entry : fs::recursive_directory_iterator(scratch / "experiments")) {
    if (entry.path().extension() != ".yaml") continue;
    const fs::path family = entry.path().parent_path().filename();
    constexpr std::uintmax_t large = 20000;  // bytes
    if (entry.file_size() > large || family == "compare" || family == "batches" || entry.path().string().find("/hard/") != std::string::npos) continue;
    samples.push_back({entry.path(), file_text(entry.path()), {{"check", entry.path()}}, scratch});
  }
  for (const std::string& text : {tiny_scene, file_text(TACK_SOURCE_DIR "/experiments/first/hang.yaml")}) {
    const fs::path path = scratch / ("small_" + std::to_string(samples.size()) + ".yaml");
    const std::vector<std::string> run = {"run", path, "-q", "--steps", "2", "-o", scratch / "results"};
    samples.push_back({path, text, {run, {"check", path}, run}, scratch});
  }
  return samples;
}

std::vector<Sample> states(const fs::path& scratch) {
  const fs::path scene = scratch / "scene.yaml", results = scratch / "results", comparison = scratch / "compare.yaml";
  write_file(scene, tiny_scene + "output: {checkpoint_interval: 0.02 s}\n");
  const ForkedResult made = run_forked(
      scratch, {"run", scene, "-q", "-o", results, "--steps", "3", "--dump-problem", "step=2", "--threads", "1"}, 60);
  if (made.exit_code != 0) throw std::runtime_error("the run to be damaged failed: " + made.printed);
  const fs::path problem = results / "problems/tiny.step2.problem", checkpoint = results / "checkpoints/step_00000002.checkpoint";
  write_file(comparison, "name: c\nproblems: [\"" + problem.string() + "\"]\ntolerances: [1]\nrepeat: 1\n"
                         "solvers: [{name: a, solver: projected_newton}]\n");
  return {{problem, file_text(problem), {{"compare", comparison, "-q", "-o", scratch / "compared"}}, scratch, true},
          {checkpoint, file_text(checkpoint), {{"run", scene, "-q", "-o", results, "--resume", "--steps", "1"}}, scratch, true}};
}

}  // namespace

std::vector<Sample> corpus(const std::string& kind, const fs::path& scratch) {
  std::vector<Sample> samples;
  if (kind == "meshes") samples = meshes(scratch);
  if (kind == "scenes") samples = scenes(scratch);
  if (kind == "states") samples = states(scratch);
  if (samples.empty()) throw std::runtime_error("no such kind: " + kind);
  std::sort(samples.begin(), samples.end(), [](const Sample& a, const Sample& b) { return a.path < b.path; });
  return samples;
}

}  // namespace tack
