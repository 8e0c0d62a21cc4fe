// Runs with following loads: their history variables survive interruptions and other numbers of
// threads, and every minimiser accepts them or refuses with a message.
#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "tests/support/program.hpp"

using namespace tack;

namespace {

// A balloon that leaks, blown at, turned and pulled to a point, onto a floor.
const std::string blown = R"(
name: blown
time: {step: 5 ms, duration: 0.2 s}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [0.6, 0.02, 0.6]}, place: {translate: [0, -0.115, 0]}, motion: [fixed]}
  - name: balloon
    shape: {type: sphere, radius: 0.1, cells: 4, surface: true}
    shell: {thickness: 1 mm}
    energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]
    loads:
      - {type: chamber, content: {type: gas, pressure: 104 kPa, leak: 5, amount: [[0, 1], [0.1, 1.05]]}}
      - {type: torque, value: 5 mN m, axis: [0, 1, 0]}
      - {type: wind, velocity: [3, 0, 1]}
      - {type: field, x: -50 * x - vx}
contact: {distance: 2 mm}
probes:
  - {name: pressure, type: chamber, chamber: balloon}
  - {name: amount, type: chamber, chamber: balloon, quantity: amount}
  - {name: at, type: centre_of_mass, object: balloon}
  - {name: done, type: energy, term: work_loads}
output: {checkpoint_interval: 0.05 s}
)";

ProgramResult run(const std::filesystem::path& folder, const std::string& scene, Arguments options) {
  options.insert(options.begin(), {"run", scene});
  return run_tack(folder, options);
}

}  // namespace

TEST_CASE("following loads go on with the same bits, whatever the threads", "[loads]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "blown.yaml", blown);
  REQUIRE(run(folder.path(), "blown.yaml", {"-o", "whole", "--threads", "1"}).exit_code == 0);
  REQUIRE(run(folder.path(), "blown.yaml", {"-o", "two", "--threads", "2"}).exit_code == 0);
  REQUIRE(run(folder.path(), "blown.yaml", {"-o", "parts", "--steps", "17"}).exit_code == 0);
  const ProgramResult resumed = run(folder.path(), "blown.yaml", {"-o", "parts", "--resume"});
  INFO(resumed.err);
  REQUIRE(resumed.exit_code == 0);
  const std::string whole = file_text(folder.path() / "whole/probes.csv");
  CHECK(file_text(folder.path() / "parts/probes.csv") == whole);
  CHECK(file_text(folder.path() / "two/probes.csv") == whole);
  const CsvTable probes = read_csv(folder.path() / "whole/probes.csv"), steps = read_csv(folder.path() / "whole/steps.csv");
  CHECK(probes.rows.back()[*probes.column("amount")] < 0.998);
  double leaked = 0, pumped = 0, done = 0;
  for (const auto& row : steps.rows) {
    leaked += row[*steps.column("dissipated_leak")];
    pumped += row[*steps.column("work_filling")];
    done += row[*steps.column("work_loads")];
  }
  CHECK(leaked > 0);
  CHECK(pumped > 0);
  CHECK(probes.rows.back()[*probes.column("done")] == Approx(done).margin(1e-12));
}

TEST_CASE("every minimiser takes following loads, or names the one that it cannot take", "[loads]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "blown.yaml", blown);
  double end = 0;
  for (const char* solver : {"{type: projected_newton, tolerance: 1e-5}", "{type: projected_newton, projection: none, tolerance: 1e-5}",
                             "{type: projected_newton, projection: progressive, tolerance: 1e-5, linear: cholmod}", "{type: projected_newton, linear: pcg, tolerance: 1e-5}",
                             "{type: newton_pcg, tolerance: 1e-5}", "{type: lbfgs, tolerance: 1e-5, max_iterations: 3000}", "{type: nonlinear_cg, tolerance: 1e-5, max_iterations: 3000}"}) {
    INFO(solver);
    const ProgramResult result = run(folder.path(), "blown.yaml", {"-o", "out", "--steps", "8", "--set", std::string("solver=") + solver});
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    const CsvTable probes = read_csv(folder.path() / "out/probes.csv");
    const double pressure = probes.rows.back()[*probes.column("pressure")];
    if (end == 0) end = pressure;
    CHECK(pressure == Approx(end).epsilon(1e-3));
  }
}

// An energy of the enclosed volume is no sum of squares; other loads contribute a linear term.
TEST_CASE("methods that want sums of squares refuse a chamber by name, and take the others", "[loads]") {
  const TemporaryFolder folder;
  const auto with = [&](const std::string& loads) {
    write_file(folder.path() / "can.yaml", "name: can\ntime: {step: 5 ms, duration: 10 ms}\nobjects:\n  - {name: can, shape: {type: box, size: [0.1, 0.1, 0.1], surface: true}, "
                                           "body: {type: affine, density: 1000}, loads: [" + loads + "]}\nsolver: {type: ceres_trust_region}\n");
    return run(folder.path(), "can.yaml", {"-o", "out"});
  };
  const ProgramResult refused = with("{type: chamber, content: {type: gas}}");
  CHECK(refused.exit_code != 0);
  CHECK_THAT(refused.err, Catch::Matchers::Contains("'chamber'"));
  CHECK(with("{type: torque, value: 1}, {type: wind, velocity: [1, 0, 0]}, {type: pressure, value: 100}, {type: field, y: -y}").exit_code == 0);
}
