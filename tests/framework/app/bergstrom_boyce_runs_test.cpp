// Runs of a block with networks of Bergstrom and Boyce: resumed, with other threads, minimisers and elements, at temperatures, and with their energy balance.
#include <catch2/catch.hpp>

#include "framework/output/csv.hpp"
#include "tests/support/program.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const std::string scene = R"(name: block
time: {step: 20 ms, duration: 0.4 s, integrator: quasi_static}
objects:
  - name: block
    shape: {type: box, size: [6 cm, 2 cm, 2 cm], cells: [6, 2, 2]}
    energies:
      - {type: neo_hookean, young: 60 kPa, poisson: 0.4, density: 1000}
      - {type: bergstrom_boyce, fraction: 2, flow_stress: 20 kPa, flow_rate: 1 1/s, exponent: 4, strain_exponent: -0.5}
      - {type: bergstrom_boyce, modulus: 10 kPa, flow_stress: 20 kPa, flow_rate: 0.1 1/s, exponent: 2}
    motion:
      - {type: fixed, select: {type: face, direction: [-1, 0, 0]}}
      - {type: keyframes, select: {type: face, direction: [1, 0, 0]}, frames: [{time: 0 s}, {time: 0.2 s, translation: [20 mm, 5 mm, 0]}, {time: 0.4 s}]}
solver: {type: projected_newton, tolerance: 1e-8}
probes:
  - {name: force, type: reaction, object: block, direction: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}
  - {name: lost, type: energy, term: dissipated_viscous}
output: {checkpoint_interval: 0.1 s}
)";

class Runs {
 public:
  Runs() { write_file(folder_.path() / "scene.yaml", scene); }
  ProgramResult go(const std::string& name, Arguments options) {
    options.insert(options.begin(), {"run", "scene.yaml", "-q", "-o", name});
    return run_tack(folder_.path(), options);
  }
  // The probes of a run that must end well.
  std::string probes(const std::string& name, const Arguments& options) {
    const ProgramResult result = go(name, options);
    INFO(result.err);
    REQUIRE(result.exit_code == 0);
    return file_text(folder_.path() / name / "probes.csv");
  }
  CsvTable table(const std::string& name, const std::string& file = "probes.csv") const { return read_csv(folder_.path() / name / file); }

 private:
  TemporaryFolder folder_;
};

}  // namespace

TEST_CASE("a network that flows has the same bits when it is resumed, and for any number of threads", "[bergstrom_boyce]") {
  for (const std::string elements : {"linear", "composite"}) {
    Runs runs;
    const std::string set = "objects.block.elements=" + elements;
    const std::string whole = runs.probes("whole", {"--set", set, "--threads", "1"});
    CHECK(runs.probes("two", {"--set", set, "--threads", "2"}) == whole);
    runs.probes("parts", {"--set", set, "--steps", "8"});
    CHECK(runs.probes("parts", {"--set", set, "--resume"}) == whole);
  }
}

TEST_CASE("a network that flows is minimised by any minimiser, and refused where it is no sum of squares", "[bergstrom_boyce]") {
  Runs runs;
  runs.probes("newton", {});
  const CsvTable newton = runs.table("newton");
  for (const std::string type : {"trust_region_newton", "newton_pcg", "lbfgs", "vertex_block_descent"}) {
    INFO(type);
    runs.probes(type, {"--set", "solver.type=" + type, "time.duration=0.1 s"});
    const CsvTable other = runs.table(type);
    for (size_t i = 1; i < other.rows.size(); ++i) CHECK(other.rows[i][1] == Approx(newton.rows[i][1]).epsilon(1e-3));
  }
  CHECK(contains(runs.go("squares", {"--set", "solver.type=ceres_trust_region"}).err, "minimises sums of squares, and 'bergstrom_boyce'"));
}

TEST_CASE("the energy balance of a network that flows closes, and it is not remeshed", "[bergstrom_boyce]") {
  Runs runs;
  for (const std::string step : {"20 ms", "10 ms"}) {
    runs.probes(step, {"--set", "time.step=" + step});
    const CsvTable steps = runs.table(step, "steps.csv");
    double lost = 0, numerics = 0;
    for (const auto& row : steps.rows) {
      CHECK(row[*steps.column("dissipated_viscous")] >= 0);
      lost += row[*steps.column("dissipated_viscous")];
      numerics += row[*steps.column("dissipated_numerics")];
    }
    INFO(step << ": lost " << lost << ", numerics " << numerics);
    CHECK(lost > 1e-2);
    CHECK(std::abs(numerics) < 2e-3 * lost);
  }
  const ProgramResult refused = runs.go("remeshed", {"--set", "objects.block.remesh={quality: 0.2, goal: 0.4}"});
  CHECK(refused.exit_code != 0);
  CHECK(contains(refused.err, "object 'block' cannot be remeshed"));
}

TEST_CASE("a network flows the faster the warmer it is", "[bergstrom_boyce]") {
  Runs runs;
  const ProgramResult unread = runs.go("unread", {"--set", "environment={temperature: 300 K}"});
  CHECK(unread.exit_code != 0);
  CHECK(contains(unread.err, "no adhesion law or energy of the scene depends on the temperature"));
  const std::string shift = "objects.block.energies.1={type: bergstrom_boyce, fraction: 2, flow_stress: 20 kPa, flow_rate: 1 1/s, exponent: 4, strain_exponent: -0.5, shift: "
                            "arrhenius, activation_energy: 60 kJ/mol, reference_temperature: 300 K}";
  std::vector<double> forces;
  for (const std::string temperature : {"280 K", "300 K", "320 K"}) {
    runs.probes(temperature, {"--set", shift, "environment={temperature: " + temperature + "}"});
    const CsvTable table = runs.table(temperature);
    forces.push_back(table.rows[10][1]);  // at the largest stretch
  }
  runs.probes("plain", {});
  CHECK(forces[1] == Approx(runs.table("plain").rows[10][1]).epsilon(1e-6));
  CHECK(forces[0] > 1.05 * forces[1]);
  CHECK(forces[1] > 1.05 * forces[2]);
}
