// tack compare from the command line.
#include <algorithm>
#include <catch2/catch.hpp>
#include <cstdlib>

#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

const std::string comparison = R"(name: two
about: a test
base: scene.yaml
steps: 3
repeat: 2
tolerances: [1 mm/s, 0.01 mm/s]
time_steps: [10 ms, 5 ms]
solvers:
  - {name: clamp, solver: {projection: clamp}}
  - {name: weak, solver: {type: projected_newton, max_iterations: 1}}
)";

struct Place {
  Place() {
    write_file(folder.path() / "scene.yaml",
               tiny_scene_with("energies:", "velocity: [0, -1, 0]\n    energies:"));
    write_file(folder.path() / "compare.yaml", comparison);
  }
  ProgramResult compare(Arguments options = {}) const {
    options.insert(options.begin(), {"compare", "compare.yaml"});
    return run_tack(folder.path(), options);
  }
  std::string text(const std::string& name) const { return file_text(folder.path() / name); }
  TemporaryFolder folder;
};

int lines(const std::string& text) { return static_cast<int>(std::count(text.begin(), text.end(), '\n')); }

}  // namespace

TEST_CASE("tack compare writes a row for every combination, also for those that fail") {
  const Place place;
  const ProgramResult result = place.compare();
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  const std::string csv = place.text("results/two/compare.csv");
  CHECK(lines(csv) == 1 + 2 * 2 * 2);
  CHECK(contains(csv, "error_floor,energy_gap,intersections,penetration,crossing_pairs,solved,error_height,error_stickiness_x,"));
  CHECK(contains(csv, "tiny,clamp,0.001,0.01,"));
  CHECK(contains(csv, "tiny,weak,1e-05,0.005,"));
  CHECK(contains(csv, "iteration limit reached"));
  const std::string report = place.text("results/two/compare.md");
  CHECK(contains(report, "2 repetitions"));
  CHECK(contains(report, "tack compare compare.yaml"));
  const nlohmann::json json = read_json(place.folder.path() / "results/two/compare.json");
  CHECK(json["references"].size() == 2);
  CHECK(json["references"][0]["problem"] == "tiny");
  CHECK(contains(json["provenance"]["command"], "tack compare compare.yaml"));
  CHECK(contains(report, "| tiny | weak | 1e-05 |"));
  CHECK(contains(report, "## Fastest at each level of error"));
  // Symmetric as it is, the block may tip either way at the impact of the larger step: its references are a millimetre apart.
  CHECK(contains(result.out, "(noise, below "));
  CHECK(fs::is_regular_file(place.folder.path() / "results/two/plots/performance_profile.gp"));
  if (!contains(result.out, "no pictures")) {
    CHECK(contains(place.text("results/two/plots/performance_profile.svg"), "<svg"));
    CHECK(contains(place.text("results/two/plots/convergence.png"), "PNG"));
  }
  REQUIRE(place.compare({"-q"}).exit_code == 0);  // the first results are kept
  CHECK(place.text("results/two.1/compare.csv") == csv);
}

TEST_CASE("tack compare solves stored steps, and the errors of one solver fall with its tolerance") {
  const Place place;
  REQUIRE(run_tack(place.folder.path(), {"run", "scene.yaml", "-q", "--steps", "3", "--dump-problem", "step=2"}).exit_code == 0);
  const ProgramResult result = place.compare(
      {"--set", "base=\"\"", "problems=[results/tiny/problems/tiny.step2.problem]", "time_steps=[]",
       "tolerances=[0.1, 1e-7]", "solvers=[{name: only, solver: projected_newton}]"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  const std::string csv = place.text("results/two/compare.csv");
  CHECK(contains(csv, "tiny.step2,only,0.1,0.01,"));
  CHECK(contains(place.text("results/two/compare.md"), "| tiny.step2 | 1e-"));
}

TEST_CASE("tack compare solves several experiments, and tells of all of them together") {
  const Place place;
  const ProgramResult result = place.compare(
      {"--set", "base=\"\"", "time_steps=[]", "repeat=1", "tolerances=[1e-3]",
       "bases=[{file: scene.yaml, steps: 1}, {name: light, file: scene.yaml, set: [\"gravity=[0, -1, 0]\"], steps: 2}]"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  const std::string csv = place.text("results/two/compare.csv");
  CHECK(lines(csv) == 1 + 2 * 2);
  CHECK(contains(csv, "tiny,clamp,0.001,"));
  CHECK(contains(csv, "light,clamp,0.001,"));
  const std::string report = place.text("results/two/compare.md");
  CHECK(contains(report, "## All 2 tasks together"));
  CHECK(contains(report, "| clamp | 2 | "));
  CHECK(contains(report, "One repetition does not show"));
  const ProgramResult twice = place.compare({"--set", "bases=[{file: scene.yaml}]"});
  CHECK(twice.exit_code == 2);
  CHECK(contains(twice.err, "two problems are named 'tiny'; give the entries of `bases` a `name`"));
}

TEST_CASE("without gnuplot, tables are written and the message names gnuplot") {
  const Place place;
  const std::string path = std::getenv("PATH");
  ::setenv("PATH", "/nowhere", 1);
  const ProgramResult result = place.compare({"--set", "repeat=1", "time_steps=[]", "tolerances=[1e-3]"});
  ::setenv("PATH", path.c_str(), 1);
  CHECK(result.exit_code == 0);
  CHECK(contains(result.out, "performance_profile: no pictures, as gnuplot is missing; install it (Debian: gnuplot-nox)"));
  CHECK(lines(place.text("results/two/compare.csv")) == 3);
  CHECK_FALSE(place.text("results/two/compare.md").empty());
  CHECK_FALSE(place.text("results/two/plots/performance_profile.gp").empty());
}

TEST_CASE("mistakes in a comparison are reported with their location, and nothing is written") {
  const Place place;
  const auto error_of = [&](const std::string& part, const std::string& wrong) {
    std::string text = comparison;
    text.replace(text.find(part), part.size(), wrong);
    write_file(place.folder.path() / "compare.yaml", text);
    const ProgramResult result = place.compare();
    CHECK(result.exit_code == 2);
    CHECK_FALSE(fs::exists(place.folder.path() / "results"));
    return result.err;
  };
  CHECK(contains(error_of("repeat:", "repaet:"), "compare.yaml:5:1: unknown key 'repaet' in the comparison; did you mean 'repeat'?"));
  CHECK(contains(error_of("projection: clamp", "projektion: clamp"), "compare.yaml:9:28: unknown key 'projektion' in minimizer"));
  CHECK(contains(error_of("projected_newton", "newton"), "unknown minimizer 'newton'"));
  CHECK(contains(error_of("name: weak", "name: clamp"), "two solvers are named 'clamp'"));
  CHECK(contains(error_of("base: scene.yaml", "base: nowhere.yaml"), "nowhere.yaml"));
  CHECK(contains(error_of("base: scene.yaml\n", ""), "give an experiment (base, bases) or stored steps (problems)"));
  CHECK(contains(error_of("base: scene.yaml", "problems: [scene.yaml]"), "is not a complete file of `tack run --dump-problem`"));
  CHECK(contains(error_of("5 ms", "7 ms"), "tiny: a time step of 0.007 s does not divide the 0.03 s"));
}

TEST_CASE("a solver's name is never run", "[compare]") {
  const Place place;
  std::string text = comparison;
  text.replace(text.find("name: clamp"), 11, R"(name: "clamp\nsystem(\"touch owned\")\n")");
  write_file(place.folder.path() / "compare.yaml", text);
  const ProgramResult result = place.compare({"--set", "repeat=1", "time_steps=[]", "tolerances=[1e-3]"});
  INFO(result.out << result.err);
  CHECK(result.exit_code == 2);  // names are one line
  CHECK_FALSE(fs::exists(place.folder.path() / "results/two/plots/owned"));
  CHECK_FALSE(fs::exists(place.folder.path() / "owned"));
}

TEST_CASE("tack compare replaces the stepper of a scene, and reports penetrations", "[compare]") {
  const Place place;
  write_file(place.folder.path() / "scene.yaml",
             "name: press\n"
             "time: {step: 20 ms, duration: 0.4 s}\n"
             "gravity: [0, -100, 0]\n"
             "objects:\n"
             "  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, 0]}, motion: [fixed]}\n"
             "  - {name: a, shape: {type: box, size: [0.2, 0.2, 0.2], cells: [3, 3, 3]}, place: {translate: [0.01, 0.101, 0]}, energies: [{type: neo_hookean, young: 1 MPa}]}\n"
             "contact: {distance: 1 mm, friction: {mu: 0.5}}\n");
  write_file(place.folder.path() / "compare.yaml",
             "name: two\nabout: a test\nbase: scene.yaml\nsteps: 6\nrepeat: 1\ntolerances: [0.1 mm/s]\n"
             "solvers:\n"
             "  - {name: minimised, solver: {type: projected_newton}}\n"
             "  - {name: constraints, stepper: {type: lcp_pgs, sweeps: 1000}}\n"
             "  - {name: one sweep, stepper: {type: lcp_pgs, sweeps: 1}}\n");
  const ProgramResult result = place.compare();
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  const std::string csv = place.text("results/two/compare.csv");
  const auto cell = [&](const std::string& solver, const std::string& column) {
    const auto split = [](const std::string& line) {
      std::vector<std::string> cells(1);
      for (const char c : line) {
        if (c == ',') cells.emplace_back();
        else cells.back() += c;
      }
      return cells;
    };
    const std::vector<std::string> header = split(csv.substr(0, csv.find('\n')));
    const auto at = csv.find("press," + solver + ",");
    REQUIRE(at != std::string::npos);
    return split(csv.substr(at, csv.find('\n', at) - at)).at(std::find(header.begin(), header.end(), column) - header.begin());
  };
  CHECK(cell("minimised", "crossing_pairs") == "0");
  CHECK(cell("constraints", "crossing_pairs") == "0");
  CHECK(std::stod(cell("constraints", "error_rms")) < 2e-3);
  CHECK(contains(csv, ",penetration,crossing_pairs"));
  CHECK(std::stod(cell("one sweep", "error_rms")) > 5 * std::stod(cell("constraints", "error_rms")));
  CHECK(contains(place.text("results/two/compare.csv"), "6 of 6 steps kept without having converged"));
}
