// Runs of rods from the command line: stored frames and turns survive, and nothing depends on
// threads or units.
#include <catch2/catch.hpp>
#include <chrono>
#include <fmt/format.h>
#include <thread>

#include "framework/output/csv.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// A helix whose lower end is turned about the tangent and about the axis, two turns in ten steps; in a system of units in which a
// length is `unit` times what it is in metres, and a mass `unit` times what it is in kilograms.
std::string helix(int edges, double duration, double unit = 1) {
  return fmt::format("name: helix\nabout: a test\ntime: {{step: 10 ms, duration: {} s}}\ngravity: [0, {}, 0]\n"
                     "solver: {{type: projected_newton, tolerance: {}, linear: cholmod}}\nobjects:\n"
                     "  - name: rod\n    shape: {{type: helix, radius: {}, pitch: {}, turns: 2, edges: {}}}\n"
                     "    rod: {{width: {}, height: {}, normal: [0, 1, 0]}}\n"
                     "    energies: [{{type: elastic_rod, young: 10 MPa, density: {}}}]\n"
                     "    motion: [{{type: rotate, axis: [0, 0.2, -1], centre: [{}, 0, 0], angular_velocity: 120 rad/s, select: {{type: indices, vertices: [0, 1]}}}}]\n"
                     "probes:\n  - {{name: end, type: separation, direction: [1, 2, 3], from: {{object: rod, select: {{type: indices, vertices: [0]}}}}, "
                     "to: {{object: rod, select: {{type: indices, vertices: [{}]}}}}}}\n"
                     "  - {{name: moment, type: torque, object: rod, select: {{type: indices, vertices: [0, 1]}}}}\n"
                     "output: {{checkpoint_interval: 0.02 s, frames: false}}\n",
                     duration, -9.81 * unit, 1e-6 * unit, 0.1 * unit, 0.1 * unit, edges, 0.01 * unit, 0.006 * unit, 1000 / (unit * unit), 0.1 * unit, edges);
}

std::string probes_of(const fs::path& folder, const std::string& name, const Arguments& more = {}) {
  Arguments arguments = {"run", name + ".yaml", "-q", "-o", name};
  arguments.insert(arguments.end(), more.begin(), more.end());
  const ProgramResult result = run_tack(folder, arguments);
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  return file_text(folder / name / "probes.csv");
}

}  // namespace

TEST_CASE("a run of a rod that is killed in the middle and resumed has the bits of one that is not", "[rod]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "whole.yaml", helix(30, 0.4));
  write_file(folder.path() / "killed.yaml", helix(30, 0.4));
  const std::string whole = probes_of(folder.path(), "whole");
  Program run(folder.path(), {"run", "killed.yaml", "-q", "-o", "killed"});
  const fs::path checkpoint = folder.path() / "killed/checkpoints/step_00000008.checkpoint";
  for (int i = 0; i < 20000 * TACK_PATIENCE && !fs::exists(checkpoint); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(1));
  run.kill();
  run.wait();
  REQUIRE(fs::exists(checkpoint));
  // From the eighth step, whatever came after it.
  for (const auto& entry : fs::directory_iterator(folder.path() / "killed/checkpoints"))
    if (entry.path().filename() > checkpoint.filename()) fs::remove(entry.path());
  CHECK(probes_of(folder.path(), "killed", {"--resume"}) == whole);
}

TEST_CASE("rods have the same bits for any number of threads", "[rod]") {
  const TemporaryFolder folder;
  for (const char* name : {"one", "two"}) write_file(folder.path() / (std::string(name) + ".yaml"), helix(700, 0.05));
  CHECK(probes_of(folder.path(), "one", {"--threads", "1"}) == probes_of(folder.path(), "two", {"--threads", "2"}));
}

TEST_CASE("rods do not depend on the system of units", "[rod]") {
  const TemporaryFolder folder;
  std::vector<CsvTable> tables;
  for (const double unit : {1.0, 1e3}) {
    write_file(folder.path() / "scene.yaml", helix(20, 0.2, unit));
    probes_of(folder.path(), "scene");
    tables.push_back(read_csv(folder.path() / "scene/probes.csv"));
    fs::remove_all(folder.path() / "scene");
  }
  REQUIRE(tables[0].rows.size() == tables[1].rows.size());
  double largest = 0;
  for (const auto& row : tables[1].rows) largest = std::max({largest, std::abs(row[2]), std::abs(row[3]), std::abs(row[4])});
  CHECK(largest > 0);
  for (size_t i = 1; i < tables[0].rows.size(); ++i) {
    CHECK(tables[1].rows[i][1] == Approx(1e3 * tables[0].rows[i][1]).epsilon(1e-6).margin(1e-5));
    for (size_t c = 2; c < 5; ++c) CHECK(tables[1].rows[i][c] == Approx(1e9 * tables[0].rows[i][c]).margin(1e-5 * largest));
  }
}
