// tack run --resume and --dump-problem from the command line.
#include <sys/stat.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <thread>

#include "framework/output/csv.hpp"
#include "framework/output/pvd.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/json.hpp"
#include "tests/support/program.hpp"
#include "tests/support/tiny_scene.hpp"
#include "tests/support/warnings.hpp"
#include "geometry/io/write_mesh.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Friction, and vertices of the block fixed for half of the run: everything that a state stores.
std::string scene_text() {
  std::string scene = tiny_scene_with("energies:", "velocity: [0.3, -0.2, 0.1]\n    motion: [{type: translate, velocity: "
                                      "[0.3, 0, 0], until: 0.055 s, select: {type: face, direction: [-1, 0, 0]}}]\n    energies:");
  scene.replace(scene.find("duration: 0.05 s"), 16, "duration: 0.1 s");
  return scene + "output: {checkpoint_interval: 0.03 s, frame_interval: 0.02 s}\n";
}

const Arguments friction = {"--set", "contact.friction={mu: 0.3}", "expect=[]"};

ProgramResult run(const fs::path& folder, Arguments options) {
  options.insert(options.begin(), {"run", "scene.yaml"});
  options.insert(options.end(), friction.begin(), friction.end());
  return run_tack(folder, options);
}

}  // namespace

TEST_CASE("adaptive steps that are resumed have the bits of those that are not") {
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark"}) {
    INFO(integrator);
    const TemporaryFolder folder;
    write_file(folder.path() / "scene.yaml", scene_text());
    const Arguments adapts = {"--set", "time.integrator=" + integrator, "--set", "time.adaptive={error: 0.05 mm}"};
    const auto go = [&](Arguments options) {
      options.insert(options.end(), adapts.begin(), adapts.end());
      return run(folder.path(), options);
    };
    const ProgramResult first = go({"-o", "whole"});
    INFO(first.out << first.err);
    REQUIRE(first.exit_code == 0);
    CHECK(contains(first.out, "repeated for their error"));
    const fs::path whole = folder.path() / "whole", parts = folder.path() / "parts";
    const CsvTable a = read_csv(whole / "steps.csv");
    REQUIRE(go({"-o", "parts", "--steps", std::to_string(a.rows.size() - 2)}).exit_code == 0);
    REQUIRE(go({"-o", "parts", "--resume"}).exit_code == 0);
    CHECK(file_text(parts / "probes.csv") == file_text(whole / "probes.csv"));
    CHECK(file_text(parts / "run.pvd") == file_text(whole / "run.pvd"));
    const CsvTable b = read_csv(parts / "steps.csv");
    REQUIRE(b.rows.size() == a.rows.size());
    const size_t counted = *a.column("wall_seconds"), size = *a.column("step_size"), error = *a.column("step_error");
    double smallest = 1, largest = 0;
    for (size_t i = 0; i < a.rows.size(); ++i) {
      for (size_t c = 0; c < counted; ++c) CHECK(a.rows[i][c] == b.rows[i][c]);
      CHECK(a.rows[i][error] == b.rows[i][error]);
      smallest = std::min(smallest, a.rows[i][size]), largest = std::max(largest, a.rows[i][size]);
    }
    CHECK(largest > 1.5 * smallest);
    for (const fs::path& f : {whole, parts}) {
      const auto sizes = read_json(f / "summary.json")["step_size"];
      CHECK(sizes["smallest"] == smallest);
      CHECK(sizes["largest"] == largest);
      CHECK(sizes["mean"].get<double>() == Approx(0.1 / static_cast<double>(a.rows.size())));
    }
    // Frames are where the scene wants them.
    const std::string frames = file_text(whole / "run.pvd");
    for (const char* time : {"\"0.02\"", "\"0.04\"", "\"0.06\"", "\"0.08\"", "\"0.1\""}) CHECK(contains(frames, time));
  }
}

TEST_CASE("a run that is interrupted and resumed has the bits of one that is not") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  REQUIRE(run(folder.path(), {"-o", "whole"}).exit_code == 0);
  REQUIRE(run(folder.path(), {"-o", "parts", "--steps", "5"}).exit_code == 0);  // past the checkpoint of step 3
  const ProgramResult resumed = run(folder.path(), {"-o", "parts", "--resume"});
  INFO(resumed.out << resumed.err);
  REQUIRE(resumed.exit_code == 0);
  CHECK(contains(resumed.out, "resumed at step 3, t = 0.03 s"));

  const fs::path whole = folder.path() / "whole", parts = folder.path() / "parts";
  CHECK(file_text(parts / "probes.csv") == file_text(whole / "probes.csv"));
  CHECK(file_text(parts / "run.pvd") == file_text(whole / "run.pvd"));
  for (int i = 0; i <= 5; ++i) {
    const fs::path frame = "frames/frame_00000" + std::to_string(i) + ".vtu";
    CHECK(file_text(parts / frame) == file_text(whole / frame));
    CHECK_FALSE(file_text(parts / frame).empty());
  }
  CsvTable a = read_csv(whole / "steps.csv"), b = read_csv(parts / "steps.csv");
  REQUIRE(a.rows.size() == 10);
  REQUIRE(b.rows.size() == 10);
  const size_t counted = *a.column("wall_seconds");  // times follow
  for (size_t i = 0; i < 10; ++i)
    for (size_t c = 0; c < counted; ++c) CHECK(a.rows[i][c] == b.rows[i][c]);
  const auto summary = read_json(parts / "summary.json");
  CHECK(summary["steps"] == 10);
  CHECK(summary["totals"]["newton_iterations"] ==
        read_json(whole / "summary.json")["totals"]["newton_iterations"]);
}

// Frame 4 is being written, into a pipe that nobody reads, when the run is killed in step 7 to 10.
TEST_CASE("a run that is killed while it writes a frame goes on from the checkpoint before", "[run]") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  REQUIRE(run(folder.path(), {"-o", "whole"}).exit_code == 0);
  REQUIRE(run(folder.path(), {"-o", "parts", "--steps", "7"}).exit_code == 0);
  const fs::path whole = folder.path() / "whole", parts = folder.path() / "parts", draft = parts / "frames/frame_000004.vtu.part";
  const std::string listed = file_text(parts / "run.pvd");
  REQUIRE(::mkfifo(draft.c_str(), 0600) == 0);
  {
    Arguments arguments = {"run", "scene.yaml", "-o", "parts", "--resume"};
    arguments.insert(arguments.end(), friction.begin(), friction.end());
    Program stuck(folder.path(), arguments);
    const auto steps = [&] { return read_csv(parts / "steps.csv").rows.size(); };
    for (int i = 0; i < 2000 && steps() < 9; ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
    CHECK(steps() == 9);  // the frame of step 8 does not stop step 9, after which a checkpoint is due
    stuck.kill();
    stuck.wait();
  }
  CHECK_FALSE(fs::exists(parts / "checkpoints/step_00000009.checkpoint"));
  CHECK(file_text(parts / "run.pvd") == listed);
  fs::remove(draft);
  REQUIRE(run(folder.path(), {"-o", "parts", "--resume"}).exit_code == 0);
  for (const char* file : {"probes.csv", "run.pvd", "frames/frame_000003.vtu", "frames/frame_000004.vtu", "frames/frame_000005.vtu"})
    CHECK(file_text(parts / file) == file_text(whole / file));
}

TEST_CASE("a spring that broke stays broken after a resume") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", R"(
name: spring
time: {step: 0.01 s, duration: 0.4 s}
objects:
  - {name: ceiling, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 1, 0]}, motion: [fixed]}
  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, body: {type: affine, density: 1000}, velocity: [0, -0.5, 0]}
interactions:
  - {type: spring, name: link, from: {object: block, select: {type: face, direction: [0, 1, 0]}}, to: {object: ceiling}, stiffness: 100, breaking_force: 2}
probes:
  - {name: force, type: spring_force, interaction: link, direction: [0, 1, 0]}
  - {name: intact, type: intact_springs, interaction: link}
  - {name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}
output: {checkpoint_interval: 0.1 s}
)");
  const auto simulate = [&](Arguments options) {
    options.insert(options.begin(), {"run", "scene.yaml"});
    return run_tack(folder.path(), options);
  };
  REQUIRE(simulate({"-o", "whole"}).exit_code == 0);
  REQUIRE(simulate({"-o", "parts", "--steps", "25"}).exit_code == 0);
  REQUIRE(contains(simulate({"-o", "parts", "--resume"}).out, "resumed at step 20"));
  CHECK(file_text(folder.path() / "parts/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  const CsvTable probes = read_csv(folder.path() / "parts/probes.csv");
  const size_t intact = *probes.column("intact");
  CHECK(probes.rows.front()[intact] > 0);
  CHECK(probes.rows[15][intact] == 0);  // before the checkpoint
  CHECK(probes.rows.back()[intact] == 0);
}

TEST_CASE("a run with a finer contact surface resumes bit for bit") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", R"(
name: fine
time: {step: 0.01 s, duration: 0.1 s}
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [0, -0.0505, 0]}, motion: [fixed]}
  - {name: cube, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.0505, 0]}, surface: {edge_length: 0.03}, velocity: [0.5, 0, 0.1],
     energies: [{type: neo_hookean, young: 1e6, poisson: 0.3, density: 1000}]}
contact: {distance: 1 mm, friction: {mu: 0.3}}
probes:
  - {name: height, type: centre_of_mass, object: cube, direction: [0, 1, 0]}
  - {name: force, type: contact_force, on: cube, from: floor, direction: [0, 1, 0]}
output: {checkpoint_interval: 0.03 s, frame_interval: 0.05 s}
)");
  const auto simulate = [&](Arguments options) {
    options.insert(options.begin(), {"run", "scene.yaml"});
    return run_tack(folder.path(), options);
  };
  const ProgramResult whole = simulate({"-o", "whole"});
  INFO(whole.out << whole.err);
  REQUIRE(whole.exit_code == 0);
  REQUIRE(simulate({"-o", "parts", "--steps", "5"}).exit_code == 0);
  REQUIRE(contains(simulate({"-o", "parts", "--resume"}).out, "resumed at step 3"));
  CHECK(file_text(folder.path() / "parts/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  CHECK(file_text(folder.path() / "parts/frames/frame_000002.vtu") == file_text(folder.path() / "whole/frames/frame_000002.vtu"));
}

TEST_CASE("contact history of integrators and the energy balance survive a resume") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  // Past the checkpoint of 0.03 s; Newmark's steps are smaller around the impact.
  for (const auto& [integrator, steps] : {std::pair<std::string, std::string>("bdf2", "5"), {"newmark", "30"}}) {
    INFO(integrator);
    const std::string set = "time.integrator=" + integrator;
    const std::string whole = integrator + "_whole", parts = integrator + "_parts";
    REQUIRE(run(folder.path(), {"-o", whole, "--set", set}).exit_code == 0);
    REQUIRE(run(folder.path(), {"-o", parts, "--steps", steps, "--set", set}).exit_code == 0);
    REQUIRE(run(folder.path(), {"-o", parts, "--resume", "--set", set}).exit_code == 0);
    CHECK(file_text(folder.path() / parts / "probes.csv") == file_text(folder.path() / whole / "probes.csv"));
    const CsvTable a = read_csv(folder.path() / whole / "steps.csv"), b = read_csv(folder.path() / parts / "steps.csv");
    const size_t counted = *a.column("wall_seconds");
    REQUIRE(b.rows.size() == a.rows.size());
    for (size_t i = 0; i < a.rows.size(); ++i)
      for (size_t c = 0; c < counted; ++c) CHECK(a.rows[i][c] == b.rows[i][c]);
    CHECK(read_json(folder.path() / parts / "summary.json")["energy"] ==
          read_json(folder.path() / whole / "summary.json")["energy"]);
  }
}

TEST_CASE("plastic deformation survives a resume bit for bit") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  const Arguments plastic = {"--set", "objects.block.energies.0={type: von_mises, young: 1 MPa, yield_stress: 200, hardening: 10 kPa}",
                             "objects.block.damping={stiffness: 1 ms}", "output.fields=[plastic_strain, von_mises_stress]",
                             "probes=[{name: plastic_work, type: energy, term: dissipated_plastic}]"};
  const auto go = [&](Arguments options) {
    options.insert(options.end(), plastic.begin(), plastic.end());
    return run(folder.path(), options);
  };
  REQUIRE(go({"-o", "whole"}).exit_code == 0);
  REQUIRE(go({"-o", "parts", "--steps", "5"}).exit_code == 0);
  REQUIRE(go({"-o", "parts", "--resume"}).exit_code == 0);
  CHECK(file_text(folder.path() / "parts/probes.csv") == file_text(folder.path() / "whole/probes.csv"));
  CHECK(file_text(folder.path() / "parts/frames/frame_000005.vtu") == file_text(folder.path() / "whole/frames/frame_000005.vtu"));
  const CsvTable work = read_csv(folder.path() / "whole/probes.csv");
  CHECK(work.rows[3].back() > 0);  // before the checkpoint, and after it
  CHECK(work.rows.back().back() > work.rows[3].back());
}

TEST_CASE("a run that cannot be resumed is reported, and nothing is written") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  const auto error_of = [&](const Arguments& options) {
    const ProgramResult result = run(folder.path(), options);
    CHECK(result.exit_code == 2);
    return result.err;
  };
  CHECK(contains(error_of({"--resume"}), "is not the results folder of a run"));
  REQUIRE(run(folder.path(), {"--steps", "2"}).exit_code == 0);
  CHECK(contains(error_of({"--resume"}), "there is no checkpoint to resume from; run with output.checkpoint_interval"));
  REQUIRE(run(folder.path(), {"--steps", "3"}).exit_code == 0);
  const std::string before = file_text(folder.path() / "results/tiny/probes.csv");
  CHECK(contains(error_of({"--resume", "--set", "gravity=[0, -1, 0]"}), "is of another scene (line "));
  CHECK(file_text(folder.path() / "results/tiny/probes.csv") == before);
}

TEST_CASE("a folder that a run writes into is refused until that run has ended, even if it was killed") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  const auto started = [&] { return fs::exists(folder.path() / "results/tiny/log.txt"); };
  Program first(folder.path(), {"run", "scene.yaml", "--set", "time.duration=1000", "expect=[]"});
  for (int i = 0; i < 2000 && !started(); ++i) std::this_thread::sleep_for(std::chrono::milliseconds(5));
  REQUIRE(started());
  const ProgramResult second = run(folder.path(), {"--steps", "1"});
  CHECK(second.exit_code == 2);
  CHECK(contains(second.err, "results/tiny: another run (process "));
  CHECK(contains(run(folder.path(), {"--resume"}).err, "another run (process "));
  CHECK_FALSE(fs::exists(folder.path() / "results/tiny.1"));
  first.kill();
  first.wait();
  CHECK(run(folder.path(), {"--steps", "1"}).exit_code == 0);
  CHECK(fs::exists(folder.path() / "results/tiny.1"));
}

TEST_CASE("a run is not resumed with another mesh or from a damaged checkpoint") {
  const TemporaryFolder folder;
  const fs::path mesh = folder.path() / "floor.msh";
  write_mesh(mesh, box_tets({1, 0.2, 1}, {1, 1, 1}));
  std::string text = scene_text();
  text.replace(text.find("{type: box, size: [1, 0.2, 1]}"), 30, "{type: file, path: floor.msh}");
  write_file(folder.path() / "scene.yaml", text);
  REQUIRE(run(folder.path(), {"--steps", "4"}).exit_code == 0);
  const auto error_of_resuming = [&] {
    const ProgramResult result = run(folder.path(), {"--resume", "--steps", "1"});
    CHECK(result.exit_code == 2);
    return result.err;
  };
  write_mesh(mesh, box_tets({1, 0.2, 1}, {2, 1, 1}));
  CHECK(contains(error_of_resuming(), "object 'floor' had another mesh (8 vertices there, 12 here); resume with the mesh"));
  write_mesh(mesh, box_tets({1.0000001, 0.2, 1}, {1, 1, 1}));
  CHECK(contains(error_of_resuming(), "object 'floor' had another mesh (its vertices lie elsewhere)"));
  write_mesh(mesh, box_tets({1, 0.2, 1}, {1, 1, 1}));

  const fs::path checkpoint = folder.path() / "results/tiny/checkpoints/step_00000003.checkpoint";
  const std::string whole = file_text(checkpoint);
  for (size_t at = 0; at < whole.size(); at += whole.size() / 10) {
    std::string damaged = whole;
    damaged[at] ^= 4;
    write_file(checkpoint, damaged);
    CHECK(contains(error_of_resuming(), "step_00000003.checkpoint: "));
  }
  write_file(checkpoint, whole);
  CHECK(run(folder.path(), {"--resume", "--steps", "1"}).exit_code == 0);
}

// A law's table and a measured curve: a run is resumed with unchanged files, or refused.
TEST_CASE("a run is not resumed once a file that its scene reads has changed") {
  const TemporaryFolder folder;
  const auto law = [](int peak) { return fmt::format("gap [mm],traction [kPa]\n0,0\n0.5,{}\n1,{}\n2,0\n", 0.5 * peak, peak); };
  const auto measured = [](double height) { return fmt::format("time [s],height [m]\n0,{0}\n0.1,{0}\n", height); };
  std::string text = scene_text();
  text.replace(text.find("{type: fang, critical_strain: 0.001}"), 36, "{type: table, file: law.csv}");
  write_file(folder.path() / "scene.yaml", text);
  const std::map<std::string, std::array<std::string, 2>> files = {{"law.csv", {law(1), law(3)}}, {"measured.csv", {measured(0.1), measured(0.2)}}};
  for (const auto& [name, contents] : files) write_file(folder.path() / name, contents[0]);
  const auto go = [&](Arguments options) {
    options.insert(options.begin(), {"run", "scene.yaml", "-q"});
    options.insert(options.end(), {"--set", "expect=[{probe: height, statistic: deviation, along: time, at_most: 10, follows: {file: measured.csv, x_column: time, y_column: height}}]"});
    return run_tack(folder.path(), options);
  };
  const ProgramResult begun = go({"--steps", "4"});
  INFO(begun.out << begun.err);
  REQUIRE(begun.exit_code == 0);
  for (const auto& [name, contents] : files) {
    write_file(folder.path() / name, contents[1]);
    const ProgramResult refused = go({"--resume"});
    INFO(refused.out << refused.err);
    CHECK(refused.exit_code == 2);
    CHECK(contains(refused.err, (folder.path() / name).string() + "' has changed since that run read it; resume with the old file"));
    write_file(folder.path() / name, contents[0]);
  }
  CHECK(go({"--resume"}).exit_code == 0);
}

TEST_CASE("intervals of output far below the time step take no time") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  for (const char* interval : {"1e-12", "1e-300"}) {
    INFO(interval);
    const std::string value = interval;
    const ProgramResult result = run(folder.path(), {"--steps", "3", "--set", "output.frame_interval=" + value,
                                                     "output.checkpoint_interval=" + value});
    CHECK(result.exit_code == 0);
    for (const char* frame : {"frame_000000.vtu", "frame_000003.vtu"})
      CHECK(fs::exists(folder.path() / "results/tiny/frames" / frame));
    CHECK(fs::exists(folder.path() / "results/tiny/checkpoints/step_00000001.checkpoint"));
  }
}

TEST_CASE("frames begin at output.frames_from") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  for (const char* interval : {"0", "0.02 s"}) {  // steps of 10 ms until 0.1 s
    INFO(interval);
    const ProgramResult result = run(folder.path(), {"-o", "out", "--set", "output.frames_from=0.05", std::string("output.frame_interval=") + interval});
    INFO(result.out << result.err);
    REQUIRE(result.exit_code == 0);
    std::vector<double> times;
    const PvdFile frames = PvdFile::continued(folder.path() / "out/run.pvd", 1);
    for (const auto& frame : frames.list()) times.push_back(frame.time);
    const std::vector<double> every{0, 0.05, 0.06, 0.07, 0.08, 0.09, 0.1}, some{0, 0.05, 0.06, 0.08, 0.1};
    const std::vector<double>& expected = interval == std::string("0") ? every : some;
    REQUIRE(times.size() == expected.size());
    for (size_t i = 0; i < times.size(); ++i) CHECK(times[i] == Approx(expected[i]).margin(1e-12));
  }
}

TEST_CASE("steps that --dump-problem names are stored, and the hardest") {
  const TemporaryFolder folder;
  write_file(folder.path() / "scene.yaml", scene_text());
  const ProgramResult result =
      run(folder.path(), {"--dump-problem", "step=4", "--dump-problem", "hardest=2", "--dump-problem", "step=99"});
  INFO(result.out << result.err);
  REQUIRE(result.exit_code == 0);
  CHECK(fs::is_regular_file(folder.path() / "results/tiny/problems/tiny.step4.problem"));
  CHECK(contains(first_text(warnings_in(folder.path() / "results/tiny/summary.json"), WarningKind::problem_not_stored), "step 99 "));
  const auto entries = fs::directory_iterator(folder.path() / "results/tiny/problems");
  const auto count = std::distance(begin(entries), end(entries));
  CHECK((count == 2 || count == 3));  // step 4 may be one of the hardest
  // A step of several stages: its first one.
  const ProgramResult staged = run(folder.path(), {"-o", "staged", "--steps", "3", "--dump-problem", "step=2", "--set", "time.integrator=tr_bdf2"});
  CHECK(contains(staged.out, "step 2, the first of 2 stages, stored as "));
  CHECK(fs::is_regular_file(folder.path() / "staged/problems/tiny.step2.stage1.problem"));
  const ProgramResult wrong = run(folder.path(), {"--dump-problem", "last"});
  CHECK(wrong.exit_code == 2);
  CHECK(contains(wrong.err, "--dump-problem last: expects step=K, counted from 1, or hardest=N"));
}
