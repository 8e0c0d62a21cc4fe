// tack run from the command line: exit codes, options, and the files that a run leaves.
#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fmt/format.h>

#include "framework/output/csv.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

struct Place {
  explicit Place(const std::string& scene = tiny_scene) { write_file(folder.path() / "scene.yaml", scene); }
  ProgramResult run(Arguments options) const {
    options.insert(options.begin(), {"run", "scene.yaml"});
    return run_tack(folder.path(), options);
  }
  fs::path path(const std::string& name) const { return folder.path() / name; }
  nlohmann::json summary(const std::string& results = "results/tiny") const {
    return read_json(path(results) / "summary.json");
  }
  CsvTable table(const std::string& name) const { return read_csv(path(name)); }

  TemporaryFolder folder;
};

// Falls freely for two steps, then hits the floor.
const std::string fall =
    tiny_scene_with("energies:", "velocity: [0, -1, 0]\n    energies:");
const Arguments hard = {"--set", "objects.block.place.translate=[0, 0.125, 0]", "--set",
                        "solver.max_iterations=1", "--set", "time.max_cutbacks=0"};

// A run that would be long, after three steps or more.
ProgramResult interrupted(const Place& place) {
  Program program(place.folder.path(), {"run", "scene.yaml", "--set", "time.duration=1000"});
  for (int i = 0; i < 20000 && file_text(place.path("results/tiny/steps.csv")).find("\n3,") == std::string::npos; ++i) ::usleep(1000);
  program.interrupt();
  return program.wait();
}

}  // namespace

TEST_CASE("a run whose expectations hold ends with 0 and writes the documented files") {
  const Place place;
  const ProgramResult result = place.run({});
  INFO(result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(contains(result.out, "pass  height: min"));
  CHECK(contains(result.out, "done: 5 steps"));
  CHECK(result.err == "");
  for (const char* name : {"scene.yaml", "run.pvd", "steps.csv", "probes.csv", "summary.json", "laws.csv", "log.txt",
                           "frames/frame_000005.vtu"})
    CHECK(fs::is_regular_file(place.path("results/tiny") / name));
  const auto summary = place.summary();
  CHECK(summary["status"] == "done");
  CHECK(summary["steps"] == 5);
  CHECK(summary["converged_steps"] == 5);
  CHECK(summary["dofs"] == 24);
  CHECK(summary["intersections"] == 0);
  CHECK(summary["max_unbalanced_force"].get<double>() > 0);
  CHECK(summary["expect"].size() == 1);
  CHECK(summary["expect"][0]["pass"] == true);
  CHECK(contains(summary["provenance"]["command"], "tack run scene.yaml"));
  CHECK(fs::equivalent(summary["provenance"]["directory"].get<std::string>(), place.folder.path()));
  CHECK(summary["provenance"]["version"] == summary["version"]);
}

TEST_CASE("laws.csv has the sum of barrier and adhesion as it acts") {
  const Place place;
  REQUIRE(place.run({"--steps", "1"}).exit_code == 0);
  const CsvTexts laws = read_csv_texts(place.path("results/tiny/laws.csv"));
  CHECK(laws.columns == std::vector<std::string>{"pair", "gap", "traction", "barrier", "adhesion"});
  REQUIRE(laws.rows.size() > 100);
  double peak = 0, at_peak = 0;
  for (const auto& row : laws.rows) {
    CHECK(row[0] == "'floor' - 'block'");
    const double gap = *csv_number(row[1]), traction = *csv_number(row[2]), barrier = *csv_number(row[3]), adhesion = *csv_number(row[4]);
    CHECK(traction == Approx(barrier + adhesion).margin(1e-9));
    CHECK(barrier <= 0);
    CHECK((gap > 1e-3 ? barrier == 0 : barrier < 0));
    if (adhesion > peak) peak = adhesion, at_peak = gap;
  }
  // 1 MPa x 0.001, at the contact distance; nothing beyond twice that.
  CHECK(peak == Approx(1000).epsilon(0.01));
  CHECK(at_peak == Approx(1e-3).epsilon(0.01));
  CHECK(*csv_number(laws.rows.back()[2]) == 0);
}

TEST_CASE("steps.csv has the documented columns and no step touches") {
  const Place place;
  REQUIRE(place.run({"-q"}).exit_code == 0);
  const CsvTable steps = place.table("results/tiny/steps.csv");
  const std::vector<std::string> columns = {
      "step", "time", "step_size", "halvings", "newton_iterations", "linear_solves", "linear_iterations",
      "line_search_evaluations", "contacts", "candidates", "min_distance", "min_gap", "energy_kinetic",
      "energy_neo_hookean", "energy_gravity", "energy_barrier", "energy_adhesion", "work_loads", "work_script", "work_rim", "work_healing",
      "dissipated_friction", "dissipated_adhesion", "dissipated_plastic", "dissipated_damping", "dissipated_areas", "dissipated_numerics", "residual",
      "unbalanced_force", "tolerated_force", "converged", "lag_iterations", "friction_residual", "wall_seconds", "seconds_other", "seconds_assembly", "seconds_projection",
      "seconds_factorize", "seconds_solve", "seconds_broad_phase", "seconds_narrow_phase", "seconds_ccd",
      "seconds_line_search", "seconds_check", "seconds_io", "rejected_solve", "rejected_inversion", "rejected_intersection", "rejected_tunnelling",
      "rejected_debonding", "rejected_error", "rejected_energy_contact", "rejected_energy_free"};
  CHECK(steps.columns == columns);
  REQUIRE(steps.rows.size() == 5);
  for (const auto& row : steps.rows) {
    CHECK(row[10] > 0);                 // min_distance
    CHECK(row[10] < 1e-3);              // the block stays near the floor
    CHECK(row[28] <= row[29]);         // forces balance
    CHECK(row[30] == 1);               // converged
  }
}

TEST_CASE("a failed expectation ends with 1, after everything is written") {
  const Place place(tiny_scene_with("at_least: 0.09", "at_least: 0.11"));
  const ProgramResult result = place.run({});
  CHECK(result.exit_code == 1);
  CHECK(contains(result.out, "FAIL  height: min"));
  CHECK(place.summary()["status"] == "expectation failed");
  CHECK(place.summary()["expect"][0]["pass"] == false);
  CHECK(place.table("results/tiny/probes.csv").rows.size() == 6);
}

TEST_CASE("a failed simulation ends with 3 and keeps the results so far") {
  const Place place(fall);
  const ProgramResult result = place.run(hard);
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 3);
  CHECK(contains(result.out, "raise solver.max_iterations"));
  const auto summary = place.summary();
  CHECK(summary["status"] == "simulation failed");
  CHECK(contains(summary["error"], "iteration limit reached"));
  CHECK(summary["expect"].empty());
  const size_t steps = summary["steps"];
  REQUIRE(steps > 0);
  CHECK(place.table("results/tiny/steps.csv").rows.size() == steps);
  CHECK(place.table("results/tiny/probes.csv").rows.size() == steps + 1);
}

TEST_CASE("a failed step is rolled back and repeated in halves, up to the end") {
  const Place place(fall);
  // The number of iterations of an impact depends on the solver: allow fewer until they do not suffice for a full step, at one of a few speeds.
  for (const char* speed : {"0.5", "0.7", "1", "1.4", "2", "3"})
    for (int allowed = 10; allowed > 2; --allowed) {
      const ProgramResult result =
          place.run({"--set", "time.step=0.02", "time.duration=0.1", fmt::format("objects.block.velocity=[0, -{}, 0]", speed),
                     "objects.block.place.translate=[0, 0.125, 0]",
                     "expect=[]", "solver.max_iterations=" + std::to_string(allowed)});
      INFO(result.out << result.err);
      if (result.exit_code != 0) break;
      if (place.summary()["failed_solves"] == 0) continue;
      CHECK(contains(result.out, "rolled back, h halved to 0.01 s"));
      const CsvTable steps = place.table("results/tiny/steps.csv");
      CHECK(steps.rows.size() > 5);
      CHECK(steps.rows.back()[1] == Approx(0.1));  // time
      return;
    }
  FAIL("no step failed and was repeated");
}

TEST_CASE("Ctrl-C ends a run with 130 and complete results so far") {
  const Place place;
  const ProgramResult result = interrupted(place);
  REQUIRE(result.exit_code == 130);
  CHECK(contains(result.out, "interrupted: "));
  const auto summary = place.summary();
  CHECK(summary["status"] == "interrupted");
  CHECK(summary["expect"].empty());
  const size_t done = summary["steps"];
  CHECK(done >= 3);
  CHECK(place.table("results/tiny/steps.csv").rows.size() == done);
}

TEST_CASE("Ctrl-C and kill end a run with 130 at once while a mesh is made") {
  const Place place(tiny_scene_with("contact:", R"(  - name: ball
    shape: {type: processed, of: {type: sphere, radius: 1}, place: {translate: [5, 0, 0]}, steps: [{type: tetrahedralize, edge_length: 0.02}]}
    motion: [fixed]
contact:)"));
  for (const bool kill : {false, true}) {
    Program program(place.folder.path(), {"run", "scene.yaml"});
    for (int i = 0; i < 20000 && !program.has_child(); ++i) ::usleep(1000);
    REQUIRE(program.has_child());
    const auto start = std::chrono::steady_clock::now();
    if (kill) program.terminate();
    else program.interrupt();
    const ProgramResult result = program.wait();
    CHECK(std::chrono::steady_clock::now() - start < std::chrono::seconds(2 * TACK_PATIENCE));
    INFO(result.out << result.err);
    CHECK(result.exit_code == 130);
    CHECK(contains(result.out, "interrupted: "));
    CHECK(result.err == "");
    CHECK_FALSE(fs::exists(place.path("results/tiny")));
  }
}

// METIS takes SIGTERM for an error of its own while it orders a matrix, in whatever thread it arrives.
TEST_CASE("of a run's threads one waits for the signals that end it, and no other takes them") {
  const Place place;
  for (const int signal : {SIGTERM, SIGHUP}) {
    const std::string results = "results-" + std::to_string(signal);
    Program program(place.folder.path(), {"run", "scene.yaml", "-o", results, "--threads", "2", "--set", "time.duration=1000",
                                          "solver.linear={type: cholmod, ordering: metis}"});
    for (int i = 0; i < 20000 && !contains(file_text(place.path(results) / "steps.csv"), "\n3,"); ++i) ::usleep(1000);
    REQUIRE(contains(file_text(place.path(results) / "steps.csv"), "\n3,"));
    for (const int each : {SIGINT, SIGTERM, SIGHUP}) CHECK(program.threads_open_to(each) == 1);
    if (signal == SIGTERM) program.terminate();
    else program.hang_up();
    CHECK(program.wait().exit_code == 130);
    CHECK(place.summary(results)["status"] == "interrupted");
  }
}

TEST_CASE("time.wall_limit ends a run with 3 and complete results so far") {
  const Place place;
  const ProgramResult result = place.run({"--set", "time.duration=100000", "time.wall_limit=0.5 s"});
  REQUIRE(result.exit_code == 3);
  CHECK(contains(result.out, "time.wall_limit: 0.5 s"));
  const auto summary = place.summary();
  CHECK(summary["status"] == "simulation failed");
  CHECK(contains(summary["error"], "the run's wall time is used up"));
  CHECK(summary["wall_seconds"] < 5.0 * TACK_PATIENCE);
  const size_t done = summary["steps"];
  CHECK(done >= 1);
  CHECK(place.table("results/tiny/steps.csv").rows.size() == done);
  CHECK(place.table("results/tiny/probes.csv").rows.size() == done + 1);
}

TEST_CASE("a wall limit that is exceeded before the first step is reported") {
  const Place place;
  for (const char* limit : {"1 us", "1 ms", "5 ms"}) {
    const ProgramResult result = place.run({"--set", "time.duration=100000", std::string("time.wall_limit=") + limit});
    INFO(result.out << result.err);
    REQUIRE(result.exit_code == 3);
    CHECK(contains(result.out, "the run's wall time is used up"));
    CHECK(result.err == "");
  }
}

TEST_CASE("a run ends in an orderly way when its terminal is closed") {
  const Place place;
  Program program(place.folder.path(), {"run", "scene.yaml", "--set", "time.duration=1000"});
  const fs::path steps = place.path("results/tiny/steps.csv");
  for (int i = 0; i < 20000 && file_text(steps).find("\n3,") == std::string::npos; ++i) ::usleep(1000);
  program.hang_up();
  CHECK(program.wait().exit_code == 130);
  CHECK(place.summary()["status"] == "interrupted");
}

TEST_CASE("an interrupted run can be resumed, with an interval of checkpoints or without") {
  const Place place;
  const ProgramResult result = interrupted(place);
  REQUIRE(result.exit_code == 130);
  const int done = place.summary()["steps"];
  const std::string step = std::to_string(done);
  CHECK(contains(result.out, "state of step " + step + " is kept: --resume goes on from there"));
  const fs::path steps = place.path("results/tiny/steps.csv");
  const std::string before = file_text(steps);
  const ProgramResult more = place.run({"--set", "time.duration=1000", "--resume", "--steps", std::to_string(done + 2)});
  INFO(more.out << more.err);
  REQUIRE(more.exit_code == 0);
  CHECK(contains(more.out, "resumed at step " + step));
  CHECK(file_text(steps).starts_with(before));
  CHECK(place.table("results/tiny/steps.csv").rows.size() == static_cast<size_t>(done) + 2);
  CHECK(place.table("results/tiny/probes.csv").rows.size() == static_cast<size_t>(done) + 3);
}

TEST_CASE("a probe without a finite number is reported once, unless it is infinite by definition") {
  const Place place(tiny_scene_with("probes:\n", "probes:\n  - {name: wrong, type: formula, of: 1 / (0 * t)}\n"
                                                "  - {name: far, type: gap, between: [block, floor]}\n"
                                                "  - {name: unknown, type: formula, of: 0 / 0}\n"));
  const ProgramResult result = place.run({"--set", "objects.block.place.translate=[0, 0.5, 0]", "expect=[]"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  std::string lost;
  for (const Warning& w : warnings_in(place.path("results/tiny/summary.json")))
    if (w.kind == WarningKind::probe_not_finite) lost += w.text + "\n";
  CHECK_THAT(lost, Catch::Matches("probe [^\n]* is -?(inf|nan) at t = 0 s[^\n]*\nprobe [^\n]* is -?(inf|nan) at t = 0 s[^\n]*\n"));
  CHECK((contains(lost, "probe unknown is nan") || contains(lost, "probe unknown is -nan")));
  CHECK(contains(lost, "probe wrong is inf"));
  CHECK(contains(result.out, "warning: " + first_text(warnings_in(place.path("results/tiny/summary.json")), WarningKind::probe_not_finite)));
}

TEST_CASE("a run that may have little memory says so at once, and ends where it is not enough") {
#ifndef __SANITIZE_ADDRESS__
  const Place place;
  const ProgramResult little = place.run({"--memory", "0.001"});
  CHECK(little.exit_code == 2);
  CHECK(contains(little.err, "memory: 0.001 GB is less than the program takes before it has read a scene; give at least"));
  for (int i = 0; i < 10; ++i) CHECK(place.run({"--memory", "0.06", "--threads", "2", "--steps", "2", "-q"}).exit_code == 0);
  const ProgramResult large = place.run({"--memory", "0.15", "--set", "objects.block.shape.cells=[40, 40, 40]"});
  INFO(large.out << large.err);
  CHECK(large.exit_code == 3);
  CHECK(contains(large.out + large.err, "not enough memory"));
#endif
}

TEST_CASE("option --steps stops early without judging the expectations") {
  const Place place(tiny_scene_with("at_least: 0.09", "at_least: 0.11"));
  CHECK(place.run({"--steps", "2"}).exit_code == 0);
  CHECK(place.summary()["steps"] == 2);
  CHECK(place.summary()["expect"].empty());
}

TEST_CASE("a run is compared with measured data in a file beside its scene") {
  const Place place(tiny_scene + "  - {name: data, probe: height, statistic: deviation, along: time, at_most: 5 %, follows: {file: data/height.csv}}\n");
  const ProgramResult missing = place.run({});
  CHECK(missing.exit_code == 2);
  CHECK(contains(missing.err, "expectation 'data': follows: "));
  CHECK(contains(missing.err, "height.csv"));
  fs::create_directory(place.path("data"));
  write_file(place.path("data/height.csv"), "# by eye\ntime [ms], height [mm]\n10, 100\n40, 110\n");
  const ProgramResult off = place.run({});
  CHECK(off.exit_code == 0);
  CHECK(contains(off.out, "pass  data"));
  CHECK(contains(off.out, "2 points, on average -"));
  CHECK(place.summary()["expect"][1]["value"].get<double>() == Approx(0.5 / 11).epsilon(0.05));  // the block has 0.16 mm to fall at the first point
  const CsvTexts points = read_csv_texts(place.path("results/tiny/measured.csv"));
  REQUIRE(points.rows.size() == 2);
  CHECK(points.columns == std::vector<std::string>{"probe", "along", "x", "measured", "computed", "stage"});
  CHECK(points.rows[1][0] == "height");
  CHECK(csv_number(points.rows[1][3]).value() == 0.11);
  CHECK(csv_number(points.rows[1][4]).value() == Approx(0.1).epsilon(0.02));
  const ProgramResult plot = run_tack(place.folder.path(), {"plot", "results/tiny"});
  if (!contains(plot.out, "gnuplot is missing")) CHECK(plot.exit_code == 0);
  const std::string script = file_text(place.path("results/tiny/plots/measured_height.gp"));
  CHECK(contains(script, "with points"));
  CHECK(contains(script, "title 'measured'"));
  const ProgramResult over = run_tack(place.folder.path(), {"plot", "results/tiny", "--x", "time", "--y", "height", "--data", "data/height.csv", "-o", "p"});
  INFO(plot.out << over.out << over.err);
  CHECK(contains(file_text(place.path("p/height_over_time.gp")), "title 'measured, height'"));  // the same points
  CHECK(run_tack(place.folder.path(), {"plot", "results/tiny", "--x", "time", "--y", "stickiness_y", "--data", "data/height.csv"}).exit_code == 2);
  write_file(place.path("data/height.csv"), "time [ms], height [mm]\n10, 100\n60, 100\n");
  CHECK(place.run({}).exit_code == 1);
  CHECK(contains(place.summary()["expect"][1]["text"].get<std::string>(), "does not pass 1 of 2 measured points"));
}

TEST_CASE("option --set replaces values, wherever it stands, and the resolved scene shows them") {
  const Place place;
  const Arguments set = {"--set", "time.step=5 ms", "--set", "objects.block.energies.0.young=2 MPa"};
  REQUIRE(place.run(set).exit_code == 0);
  CHECK(place.summary()["steps"] == 10);
  CHECK(contains(file_text(place.path("results/tiny/scene.yaml")), "young: 2000000  # Pa"));

  const Arguments before = {"run", "--set", "time.step=5 ms", "scene.yaml", "-o", "before"};
  REQUIRE(run_tack(place.folder.path(), before).exit_code == 0);
  CHECK(place.summary("before")["steps"] == 10);
}

TEST_CASE("the resolved scene is a scene that gives the same run") {
  const Place place;
  REQUIRE(place.run({"-q", "-o", "first"}).exit_code == 0);
  REQUIRE(run_tack(place.folder.path(), {"run", "first/scene.yaml", "-q", "-o", "second"}).exit_code == 0);
  CHECK(file_text(place.path("second/probes.csv")) == file_text(place.path("first/probes.csv")));
  CHECK(file_text(place.path("second/scene.yaml")) == file_text(place.path("first/scene.yaml")));
}

TEST_CASE("option -q prints nothing, -v every step, and the log has every step anyway") {
  const Place place;
  const ProgramResult quiet = place.run({"-q", "-o", "quiet"});
  CHECK(quiet.exit_code == 0);
  CHECK(quiet.out == "");
  CHECK(quiet.err == "");
  CHECK(contains(file_text(place.path("quiet/log.txt")), "step 4  t 0.04 s"));
  CHECK(contains(place.run({"-v", "-o", "verbose"}).out, "step 4  t 0.04 s"));
}

TEST_CASE("an earlier run is moved aside") {
  const Place place;
  REQUIRE(place.run({"-q", "--steps", "1"}).exit_code == 0);
  const ProgramResult again = place.run({"--steps", "2"});
  REQUIRE(again.exit_code == 0);
  CHECK(contains(again.out, "results/tiny.1"));
  CHECK(place.summary("results/tiny.1")["steps"] == 1);
  CHECK(place.summary()["steps"] == 2);
}
