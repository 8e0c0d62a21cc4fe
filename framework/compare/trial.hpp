// One solver on one case, in its own world: factors and candidates of other trials do not help it.
// The measured time is that of the minimisation of a single step, or of the steps of a run with
// their verification; loading is excluded.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/output/state_file.hpp"
#include "framework/run/simulation.hpp"

namespace tack {

// A compared case: an experiment from its initial state, or the time step of a problem file.
struct CompareCase {
  std::string name;
  std::string path;
  std::vector<std::string> overrides;  // overrides of an experiment
  std::optional<StateFile> problem;
  double step_size = 0;  // its own [s]
  int steps = 1;         // number of steps of step_size
  double size = 0;       // diagonal of all that moves [m]
  bool quasi_static = false;
  double branch_distance = 1e-3;  // of runs on one branch, relative to the size

  bool single() const { return problem.has_value(); }
  // Returns the number of steps of size h to the same end time. Throws InputError if h does not
  // divide it.
  int steps_of(double h) const;
  LoadedExperiment load() const;
};

CompareCase experiment_case(const std::string& path, const std::vector<std::string>& overrides,
                            int steps);
CompareCase problem_case(const std::string& path);

struct TrialSettings {
  Value solver;          // overrides of the scene's solver
  double tolerance = 0;  // m/s
  double step_size = 0;  // s
  Value stepper = {};    // overrides of the scene's stepper
  Value time = {};       // overrides of the rest of the scene's time
};

struct TrialResult {
  std::string status;  // "converged", or the error
  bool converged = false;
  bool complete = false;  // the end was reached: x is the final state
  double wall_seconds = 0, cpu_seconds = 0;
  int steps = 0;
  long iterations = 0, evaluations = 0, linear_solves = 0;
  int intersections = 0;  // includes inverted tets; of the last state
  // Maxima over the steps, for steppers that let surfaces pass through each other; penetration in
  // m.
  double penetration = 0, crossing_pairs = 0;
  VecX x;             // 3n [m]
  double energy = 0;  // at the end of a run [J]
  std::vector<double> probes;
};

struct Iteration {
  int number;
  double residual;  // in tolerances
  double value;     // of the objective
  double seconds;
};

class Trial {
 public:
  // Builds the world of the trial. Throws InputError for settings that do not fit the case.
  Trial(const CompareCase& compare_case, const TrialSettings& settings);
  // Runs the trial. `guess`: feasible initial guess of a single step (3n).
  const TrialResult& run(const VecX* guess = nullptr);
  const TrialResult& result() const { return result_; }
  const std::vector<std::string>& probe_columns() const { return probes_.columns(); }
  // Records the iterations of the most expensive step. Costs time: not for timed runs.
  void record() { recording_ = true; }
  const std::vector<Iteration>& history() const { return longest_; }
  // Returns the potential of the solved single step at x, divided by beta h^2 [J].
  double potential_at(const VecX& x) { return simulation_.stepper().potential_at(x); }
  const World& world() const { return simulation_.world(); }

 private:
  void solve_step(const VecX* guess);
  void solve_run();
  void record_maxima(const std::vector<StepMetric>& metrics);
  void evaluate_end();

  const CompareCase& case_;
  double h_;
  Simulation simulation_;
  ProbeSet probes_;
  bool recording_ = false;
  std::vector<Iteration> present_, longest_;
  TrialResult result_;
};

}  // namespace tack
