// Runs with bonds: their history variables survive interruptions, other numbers of threads, and
// repeated loads.
#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

// A soft strip that is torn off a plate from one end and pressed on again, so that bonds break, heal and form; its meshes do not match.
const std::string torn = R"(
name: torn
time: {step: 5 ms, duration: 0.3 s}
objects:
  - {name: plate, shape: {type: box, size: [40 mm, 2 mm, 10 mm], cells: [9, 1, 3]}, place: {translate: [0, -1.4 mm, 0]}, motion: [fixed]}
  - name: strip
    shape: {type: box, size: [36 mm, 2 mm, 8 mm], cells: [14, 1, 3]}
    place: {translate: [0, 1.4 mm, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
    motion: [{type: formula, y: "t < 0.15 ? 0.01 * t : 0.0033 - 0.012 * t", select: {type: face, direction: [-1, 0, 0]}}]
contact:
  distance: 1 mm
  pairs:
    - between: [strip, plate]
      adhesion: {type: rcc, normal_stiffness: 20 MPa/m, tangential_stiffness: 10 MPa/m, work_of_adhesion: 0.5 J/m^2, viscosity: 1 mJ s/m^2, healing: 0.1 1/(Pa s)}
probes:
  - {name: bonds, type: bonds, between: [strip, plate]}
  - {name: intact, type: bonds, between: [strip, plate], quantity: intact_area}
  - {name: force, type: contact_force, on: strip, from: plate, direction: [0, 1, 0]}
output: {checkpoint_interval: 0.05 s, frame_interval: 0.1 s, fields: [bond_intensity, bond_traction, adhesion_pressure]}
)";

ProgramResult run(const std::filesystem::path& folder, const std::string& scene, Arguments options) {
  options.insert(options.begin(), {"run", scene});
  return run_tack(folder, options);
}

double last(const CsvTable& table, const char* column) { return table.rows.back()[*table.column(column)]; }

}  // namespace

TEST_CASE("broken, healed and new bonds resume with the same bits, for any number of threads", "[bonds]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "torn.yaml", torn);
  REQUIRE(run(folder.path(), "torn.yaml", {"-o", "whole", "--threads", "1"}).exit_code == 0);
  REQUIRE(run(folder.path(), "torn.yaml", {"-o", "two", "--threads", "2"}).exit_code == 0);
  for (const char* steps : {"13", "37", "52"}) {
    REQUIRE(run(folder.path(), "torn.yaml", {"-o", "parts", "--steps", steps}).exit_code == 0);
    const ProgramResult resumed = run(folder.path(), "torn.yaml", {"-o", "parts", "--resume"});
    INFO(steps << resumed.err);
    REQUIRE(resumed.exit_code == 0);
    CHECK(file_text(folder.path() / "parts/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  }
  CHECK(file_text(folder.path() / "two/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  const CsvTable probes = read_csv(folder.path() / "whole/probes.csv"), steps = read_csv(folder.path() / "whole/steps.csv");
  // The values vary in time.
  double least = 1, most = 0, dissipated = 0, healing = 0;
  for (const auto& row : probes.rows) {
    const double intact = row[*probes.column("intact")];
    if (row[0] > 0) least = std::min(least, intact);
    most = std::max(most, intact);
  }
  for (const auto& row : steps.rows) dissipated += row[*steps.column("dissipated_adhesion")], healing += std::abs(row[*steps.column("work_healing")]);
  CHECK(most == Approx(36e-3 * 8e-3).epsilon(0.02));
  CHECK(least < 0.8 * most);
  CHECK(last(probes, "intact") > 1.1 * least);
  CHECK(dissipated > 0);
  CHECK(healing > 0);
}

TEST_CASE("a hundred loads below the strength do no more damage than the first", "[bonds]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "cycles.yaml", R"(
name: cycles
time: {step: 10 ms, duration: 10 s, integrator: quasi_static}
objects:
  - {name: held, shape: {type: box, size: [10 mm, 2 mm, 10 mm], cells: [3, 1, 3]}, place: {translate: [0, 1.5 mm, 0]}, motion: [fixed]}
  - name: pulled
    shape: {type: box, size: [10 mm, 2 mm, 10 mm], cells: [2, 1, 2]}
    place: {translate: [0, -1.5 mm, 0]}
    energies: [{type: neo_hookean, young: 10 GPa, density: 1000}]
    motion: [{type: formula, y: "-1e-4 * (1 - cos(20 * pi * t)) / 2", select: {type: face, direction: [0, -1, 0]}}]
contact:
  distance: 1 mm
  pairs: [{between: [held, pulled], bond_distance: 1.1 mm, adhesion: {type: bilinear, peak_traction: 10 kPa, work_of_adhesion: 1 J/m^2, onset: 50 um}}]
probes: [{name: intensity, type: bonds, between: [held, pulled], quantity: least_intensity}]
output: {frames: false}
)");
  REQUIRE(run(folder.path(), "cycles.yaml", {"-o", "cycles"}).exit_code == 0);
  const CsvTable probes = read_csv(folder.path() / "cycles/probes.csv");
  REQUIRE(probes.rows.size() > 999);
  // (d_f - d) / (d_f - d_0) * d_0 / d at d = 0.1 mm, d_f = 0.2 mm.
  for (size_t i = 6; i < probes.rows.size(); ++i) CHECK(probes.rows[i][*probes.column("intensity")] == Approx(1.0 / 3).epsilon(1e-3));
  CHECK(last(probes, "intensity") == Approx(probes.rows[10][*probes.column("intensity")]).epsilon(1e-4));
}

TEST_CASE("objects that start as they were are bonded as they were", "[bonds]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "torn.yaml", torn);
  REQUIRE(run(folder.path(), "torn.yaml", {"-o", "before", "--steps", "20"}).exit_code == 0);
  write_file(folder.path() / "after.yaml", "include: torn.yaml\nname: after\nstart: {from: before}\n");
  const ProgramResult after = run(folder.path(), "after.yaml", {"-o", "after", "--steps", "1"});
  INFO(after.err);
  REQUIRE(after.exit_code == 0);
  const CsvTable then = read_csv(folder.path() / "before/probes.csv"), now = read_csv(folder.path() / "after/probes.csv");
  CHECK(then.rows[20][*then.column("intact")] < 0.95 * 36e-3 * 8e-3);
  CHECK(now.rows[0][*now.column("intact")] == then.rows[20][*then.column("intact")]);
}
