// A term with history variables is one file: this one gives elements a history that the loop,
// checkpoints and stored problems carry bit for bit.
#include "framework/core/history.hpp"

#include <sys/wait.h>
#include <unistd.h>

#include <catch2/catch.hpp>
#include <chrono>
#include <csignal>
#include <fmt/format.h>
#include <sstream>
#include <tbb/global_control.h>
#include <thread>

#include "framework/checks/derivative_check.hpp"
#include "framework/compare/trial.hpp"
#include "framework/config/parse.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "framework/output/provenance.hpp"
#include "framework/run/recorded_run.hpp"
#include "tests/support/program.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;
namespace fs = std::filesystem;

namespace {

// Along the edges of tets, u = (x_b - x_a) - (X_b - X_a) and L = |X_b - X_a|:
//     E = sum k_e (|u|^2 / 2 + |u|^4 / (4 L^2)),   k_e = k (1 + n_e / 100 + s_e),
// n_e: the steps so far, s_e: the sum of |u| / L at their ends.
class HistoryTerm : public Term {
 public:
  HistoryTerm(const Body& body, const VecX& rest, double stiffness)
      : Term("remembering"), stiffness_(stiffness), name_(fmt::format("{}/energies/{}/use", body.name, body.energy)) {
    for (const Tet& t : body.tets)
      for (int i = 0; i < 4; ++i)
        for (int j = 0; j < i; ++j) edges_.push_back({t[i], t[j]});
    for (const Edge& e : edges_) spans_.push_back(vertex(rest, e[1]) - vertex(rest, e[0]));
    load_history({});
  }

  void load_history(const History& history) override {
    const std::vector<double>* known = history_values(history, name_, 2, count());
    use_ = known ? *known : std::vector<double>(2 * edges_.size(), 0.0);
  }
  void commit(const VecX& x, History& history) const override {
    HistoryArray& array = history[name_];
    array = {2, use_, {}};
    for (int e = 0; e < count(); ++e) {
      array.values[2 * e] += 1;
      array.values[2 * e + 1] += u(e, x).norm() / spans_[e].norm();
    }
  }

  double value(const VecX& x) const override {
    double sum = 0;
    for (int e = 0; e < count(); ++e) {
      const double s = u(e, x).squaredNorm();
      sum += k(e) * (s / 2 + s * s / (4 * spans_[e].squaredNorm()));
    }
    return sum;
  }
  std::vector<StencilBatch> batches() const override { return {{2, count(), edges_.front().data()}}; }
  void derivatives(const VecX& x, Projection, double* gradient, double* hessian) const override {
    for (int e = 0; e < count(); ++e) {
      const Vec3 elongation = u(e, x);
      const double l2 = spans_[e].squaredNorm(), hardened = k(e) * (1 + elongation.squaredNorm() / l2);
      Eigen::Map<Vec3>{gradient + 6 * e} = -hardened * elongation;
      Eigen::Map<Vec3>{gradient + 6 * e + 3} = hardened * elongation;
      if (!hessian) continue;
      const Mat3 h = hardened * Mat3::Identity() + 2 * k(e) / l2 * elongation * elongation.transpose();
      Eigen::Map<Mat3>{hessian + 27 * e} = h;
      Eigen::Map<Mat3>{hessian + 27 * e + 9} = -h;
      Eigen::Map<Mat3>{hessian + 27 * e + 18} = h;
    }
  }

 private:
  int count() const { return static_cast<int>(edges_.size()); }
  Vec3 u(int e, const VecX& x) const { return vertex(x, edges_[e][1]) - vertex(x, edges_[e][0]) - spans_[e]; }
  double k(int e) const { return stiffness_ * (1 + use_[2 * e] / 100 + use_[2 * e + 1]); }

  double stiffness_;
  std::string name_;
  std::vector<Edge> edges_;
  std::vector<Vec3> spans_;
  std::vector<double> use_;  // per edge: n, s
};

class HistoryEnergy : public Energy {
 public:
  void fields(Fields& f) override { f.number("stiffness", stiffness_, units::stiffness, "k at the start").positive(); }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    return std::make_unique<HistoryTerm>(body, rest, stiffness_);
  }
  void add_mass(const Body& body, const VecX&, VecX& mass) const override {
    mass.segment(body.first_vertex, body.vertex_count).array() += 0.1;
  }

 private:
  double stiffness_ = 500;  // N/m
};

TACK_REGISTER(Energy, HistoryEnergy, "remembering", "Springs that count how they are used.", "tests");

// A bar fixed at one end while the other flies off; hard for few iterations.
std::string scene_with(int iterations, const std::string& integrator = "implicit_euler", double duration = 0.2) {
  return fmt::format("time: {{step: 0.02, duration: {}, integrator: {}}}\n"
                     "solver: {{type: projected_newton, linear: cholmod, tolerance: 1 mm/s, max_iterations: {}}}\n"
                     "objects: [{{name: bar, shape: {{type: box, size: [0.4, 0.1, 0.1], cells: [4, 1, 1]}},\n"
                     "  velocity: [3, 4, 0], energies: [remembering],\n"
                     "  motion: [{{type: fixed, select: {{type: face, direction: [-1, 0, 0]}}}}]}}]\n"
                     "probes: [{{name: tip, type: centre_of_mass, object: bar}}]\n"
                     "output: {{checkpoint_interval: 0.04 s, frames: false}}\n",
                     duration, integrator, iterations);
}

constexpr int enough = 100;
constexpr const char* array_name = "bar/energies/0/use";

// Returns the number of steps that the first element has counted.
double counted(const State& state) { return state.history.at(array_name).values[0]; }

bool same(const State& a, const State& b) {
  return a.x == b.x && a.v == b.v && a.history == b.history && a.time == b.time && a.step == b.step;
}

RunSettings in(const fs::path& folder, int steps, bool resume = false) {
  RunSettings settings;
  settings.output = folder.string();
  settings.steps = steps;
  settings.resume = resume;
  return settings;
}

LoadedExperiment loaded(const std::string& yaml) { return parse_experiment("name: memory\n" + yaml, "memory.yaml"); }

RunSummary record(const std::string& yaml, const RunSettings& settings) {
  std::ostringstream output;
  RecordedRun run(loaded(yaml), settings, provenance_of("", 1), output, {});
  const RunSummary summary = run.execute();
  INFO(output.str());
  REQUIRE(summary.status == RunStatus::done);
  return summary;
}

fs::path checkpoint(const fs::path& folder, int step) {
  return folder / "checkpoints" / fmt::format("step_{:08}.checkpoint", step);
}

State state_at(const fs::path& folder, int step) {
  return read_state_file(checkpoint(folder, step), StateFile::Kind::checkpoint).state;
}

// Returns the number of the newest checkpoint; 0 if there is none.
int newest(const fs::path& folder) {
  int step = 0;
  while (fs::exists(checkpoint(folder, step + 2))) step += 2;
  return step;
}

// Runs a scene in a separate process, which is killed once it has a checkpoint of step 12.
void run_and_kill(const std::string& yaml, const fs::path& folder) {
  const pid_t child = fork();
  REQUIRE(child >= 0);
  if (child == 0) {
    const tbb::global_control one(tbb::global_control::max_allowed_parallelism, 1);
    try {
      std::ostringstream output;
      RecordedRun(loaded(yaml), in(folder, 0), provenance_of("", 1), output, {}).execute();
    } catch (...) {
    }
    _exit(1);
  }
  for (int i = 0; i < 20000 * TACK_PATIENCE && !fs::exists(checkpoint(folder, 12)); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(1));
  kill(child, SIGKILL);
  int status = 0;
  REQUIRE(waitpid(child, &status, 0) == child);
  REQUIRE(WIFSIGNALED(status));
}

}  // namespace

TEST_CASE("the energy with history has the derivatives of its value", "[history]") {
  TestScene scene(scene_with(enough));
  for (const DerivativeCheck& check : check_derivatives(*scene.world, 0.02, scene.clock)) CHECK_FALSE(check.wrong());
}

TEST_CASE("an accepted step is stored once, and changes later steps", "[history]") {
  TestRun run(scene_with(enough));
  CHECK(run.state().history.empty());
  for (int n = 1; n <= 5; ++n) {
    CHECK(run.step().rejections.cutbacks() == 0);
    CHECK(counted(run.state()) == n);
  }
  // The energy at these positions is larger than without history.
  const State& end = run.state();
  const double used = run.world->elastic_terms[0]->value(end.x);
  run.world->participants.load_history({});
  CHECK(used > 1.05 * run.world->elastic_terms[0]->value(end.x));
}

TEST_CASE("a failed solve and rejected substeps do not change the history", "[history]") {
  TestRun run(scene_with(enough));
  run.step();
  const State before = run.state();

  TestRun failing(scene_with(2));
  failing.simulation.start_from(before);
  TimeStepper& stepper = failing.simulation.stepper();
  const SolveResult result = stepper.solve(0.02);
  CHECK(result.minimizer.status == MinimizerStatus::iteration_limit);
  CHECK_FALSE(stepper.validate(result).fault.empty());
  CHECK((result.x != before.x));
  CHECK(same(stepper.state(), before));

  // A step that fails and succeeds with substeps, and a run that begins with those substeps.
  const StepReport cut_back = failing.step();
  REQUIRE(cut_back.rejections.cutbacks() > 0);
  TestRun resumed(scene_with(2));
  State smaller = before;
  smaller.step_size.h_next = cut_back.step_size;
  resumed.simulation.start_from(smaller);
  CHECK(resumed.step().rejections.cutbacks() == 0);
  CHECK(same(failing.state(), resumed.state()));
  CHECK(counted(failing.state()) == 2);
  while (failing.state().time < 3 * 0.02 * (1 - 1e-9)) failing.step();
  CHECK(counted(failing.state()) == failing.state().step);
}

TEST_CASE("a step that is undone because of its energy is not stored", "[history]") {
  // Springs that stiffen while they are stretched gain energy without a source.
  TestRun run(scene_with(enough, "newmark"));
  int damped = 0;
  for (int n = 1; n <= 8; ++n) {
    damped += run.step().flows.damped;
    CHECK(counted(run.state()) == n);
  }
  CHECK(damped > 0);
}

TEST_CASE("the history survives a checkpoint and a resume", "[history]") {
  const TemporaryFolder folder;
  const fs::path uninterrupted = folder.path() / "whole", resumed = folder.path() / "parts";
  record(scene_with(enough), in(uninterrupted, 0));
  record(scene_with(enough), in(resumed, 5));
  record(scene_with(enough), in(resumed, 0, true));
  const State a = state_at(uninterrupted, 10), b = state_at(resumed, 10);
  CHECK(same(a, b));
  CHECK(counted(a) == 10);
  CHECK(file_text(resumed / "probes.csv") == file_text(uninterrupted / "probes.csv"));
}

TEST_CASE("the history is part of a stored problem", "[history]") {
  const TemporaryFolder folder;
  RunSettings settings = in(folder.path() / "run", 0);
  settings.dump_problems = {"step=8"};
  record(scene_with(enough), settings);
  const fs::path path = folder.path() / "run/problems/memory.step8.problem";
  const StateFile problem = read_state_file(path, StateFile::Kind::problem);
  CHECK(counted(problem.state) == 7);
  const State end = state_at(folder.path() / "run", 8);

  Simulation again(experiment_of(problem, path.string()));
  again.start_from(problem.state);
  again.step();
  CHECK(same(again.state(), end));

  const CompareCase compared = problem_case(path.string());
  Trial trial(compared, {parse_string("{type: projected_newton, linear: cholmod}", "test"), 1e-3, compared.step_size});
  CHECK((trial.run().x == end.x));

  // Without it, the step ends elsewhere.
  State without_history = problem.state;
  without_history.history.clear();
  again.start_from(without_history);
  again.step();
  CHECK((again.state().x != end.x));
}

TEST_CASE("the history survives a run that is killed", "[history]") {
  const TemporaryFolder folder;
  const std::string endless = scene_with(enough, "implicit_euler", 1e5);
  const fs::path killed = folder.path() / "killed", uninterrupted = folder.path() / "whole";
  run_and_kill(endless, killed);
  const int there = newest(killed);
  REQUIRE(there >= 12);
  CHECK(counted(state_at(killed, there)) == there);
  record(endless, in(killed, there + 8, true));
  record(endless, in(uninterrupted, there + 8));
  CHECK(same(state_at(killed, there + 8), state_at(uninterrupted, there + 8)));
  CHECK(file_text(killed / "probes.csv") == file_text(uninterrupted / "probes.csv"));
}
