#include "framework/compare/trial.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "framework/config/bind.hpp"
#include "framework/config/merged_component.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "framework/run/cpu_limit.hpp"
#include "framework/run/exact_check.hpp"
#include "framework/setup/remesh_checks.hpp"
#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Wall time and CPU time of all threads of this process.
class Stopwatch {
 public:
  explicit Stopwatch(TrialResult& result) : result_(result) {}
  ~Stopwatch() {
    const std::chrono::duration<double> wall = std::chrono::steady_clock::now() - wall_;
    result_.wall_seconds = wall.count();
    result_.cpu_seconds = cpu_now() - cpu_;
  }
  Stopwatch(const Stopwatch&) = delete;
  Stopwatch& operator=(const Stopwatch&) = delete;

 private:
  TrialResult& result_;
  std::chrono::steady_clock::time_point wall_ = std::chrono::steady_clock::now();
  double cpu_ = cpu_now();
};

double extent_of_movable(const World& world) {
  Eigen::AlignedBox3d box;
  for (const Body& body : world.bodies)
    for (int v = body.first_vertex; body.movable && v < body.first_vertex + body.vertex_count; ++v)
      box.extend(Vec3(vertex(world.rest, v)));
  return box.diagonal().norm();
}

// Applies the settings to an experiment that runs up to a time [s].
LoadedExperiment with(LoadedExperiment loaded, const TrialSettings& settings, double until) {
  Experiment& experiment = loaded.experiment;
  Value solver = merged_component(experiment.solver.get(), settings.solver);
  solver.set("tolerance", Value::number(settings.tolerance));
  experiment.solver = bind_component<Minimizer>(solver);
  if (!settings.stepper.is_null()) experiment.time.stepper = bind_component<Stepper>(merged_component(experiment.time.stepper.get(), settings.stepper));
  experiment.time.step = settings.step_size;
  if (!settings.time.is_null()) bind(settings.time, experiment.time, "time");
  if (experiment.time.adaptive) experiment.time.duration = until;
  experiment.time.max_cutbacks = 0;  // failed solves are counted, not repeated with substeps
  return loaded;
}

// Builds the case once, so that its errors show before the measurement.
void measure_case(CompareCase& c) {
  const BuiltExperiment built(c.load());
  probes_of(built);
  const World& world = built.world();
  if (c.problem) check_size(*c.problem, world.rest.size() / 3, c.path);
  c.size = extent_of_movable(world);
  c.quasi_static = !built.experiment().time.integrator->inertia();
}

}  // namespace

LoadedExperiment CompareCase::load() const {
  return problem ? experiment_of(*problem, path) : load_experiment(path, overrides);
}

int CompareCase::steps_of(double h) const {
  if (single()) return 1;
  const double time = steps * step_size, count = std::round(time / h);
  if (count < 1 || std::abs(count * h - time) > 1e-6 * h)
    throw InputError(fmt::format("{}: a time step of {} s does not divide the {:.6g} s that are compared; choose another "
                                 "one in time_steps, or other steps", name, h, time));
  return static_cast<int>(count);
}

CompareCase experiment_case(const std::string& path, const std::vector<std::string>& overrides, int steps) {
  CompareCase c;
  c.path = path;
  c.overrides = overrides;
  const LoadedExperiment loaded = c.load();
  if (any_remeshed(loaded.experiment))
    throw InputError(fmt::format("{}: remeshed objects have other vertices in each run, so that positions of vertices cannot be compared; take "
                                 "`remesh` away (--set objects.NAME.remesh=null)", path));
  c.name = loaded.experiment.name;
  c.step_size = loaded.experiment.time.step;
  const double all = loaded.experiment.time.duration / c.step_size;
  c.steps = steps > 0 ? steps : std::max(1, static_cast<int>(std::ceil(all - 1e-9)));
  measure_case(c);
  return c;
}

CompareCase problem_case(const std::string& path) {
  CompareCase c;
  c.path = path;
  c.name = std::filesystem::path(path).stem().string();
  c.problem = read_state_file(path, StateFile::Kind::problem);
  c.step_size = c.problem->step_size;
  measure_case(c);
  return c;
}

Trial::Trial(const CompareCase& compare_case, const TrialSettings& settings)
    : case_(compare_case), h_(settings.step_size), simulation_(with(compare_case.load(), settings, compare_case.steps * compare_case.step_size)),
      probes_(probes_of(simulation_.built())) {
}

const TrialResult& Trial::run(const VecX* guess) {
  if (recording_) {
    const auto note = [this](int, double residual, double value, double seconds) {
      present_.push_back({static_cast<int>(present_.size()) + 1, residual, value, seconds});
      if (present_.size() > longest_.size()) longest_ = present_;
    };
    simulation_.observe({note, note, {}, true});
  }
  simulation_.start_from(case_.problem ? case_.problem->state : simulation_.world().start);
  if (case_.single()) solve_step(guess);
  else solve_run();
  if (result_.complete) evaluate_end();
  return result_;
}

void Trial::solve_step(const VecX* guess) {
  std::optional<SolveResult> solved;
  try {
    const Stopwatch watch(result_);
    solved = simulation_.stepper().solve(h_, guess);
  } catch (const SimulationError& error) {
    result_.status = error.what();
    return;
  }
  const MinimizerResult& solve = solved->minimizer;
  result_.iterations = solve.iterations;
  result_.evaluations = solve.line_search_evaluations;
  result_.linear_solves = solve.linear_solves;
  record_maxima(solved->metrics);
  result_.converged = solved->failure.empty() && solve.status == MinimizerStatus::converged;
  result_.status = solved->failure.empty() ? status_text(*solved) : solved->failure;
  result_.complete = solved->failure.empty() && solved->x.allFinite();
  if (result_.complete) simulation_.stepper().commit(solved->x, h_);
}

void Trial::solve_run() {
  const bool adapts = simulation_.experiment().time.adaptive.has_value();
  const int steps = adapts ? 0 : case_.steps_of(h_);
  StepReport report;
  result_.status = "converged";
  try {
    const Stopwatch watch(result_);
    int unconverged = 0;  // accepted steps that did not converge
    for (int i = 0; adapts ? !simulation_.finished() : i < steps; ++i) {
      present_.clear();
      report = simulation_.step();
      if (simulation_.interrupted()) throw SimulationError("interrupted");
      result_.iterations += report.solve.iterations;
      result_.evaluations += report.solve.line_search_evaluations;
      result_.linear_solves += report.solve.linear_solves;
      ++result_.steps;
      unconverged += report.converged ? 0 : 1;
      record_maxima(report.metrics);
    }
    if (unconverged > 0) result_.status = fmt::format("{} of {} steps kept without having converged", unconverged, result_.steps);
    result_.converged = result_.complete = true;
  } catch (const SimulationError& error) {
    result_.status = error.what();
    return;
  }
  result_.energy += stored_energy(report.energies);
}

void Trial::record_maxima(const std::vector<StepMetric>& metrics) {
  for (const StepMetric& metric : metrics) {
    if (metric.name == "penetration") result_.penetration = std::max(result_.penetration, metric.value);
    if (metric.name == "crossing_pairs") result_.crossing_pairs = std::max(result_.crossing_pairs, metric.value);
  }
}

void Trial::evaluate_end() {
  result_.x = simulation_.state().x;
  const World& world = simulation_.world();
  result_.intersections = intersections_at(world, result_.x);
  if (world.contact) {
    world.contact->at(result_.x, [&] { result_.probes = probes_.sample(world, simulation_.state()); });
  } else {
    result_.probes = probes_.sample(world, simulation_.state());
  }
}

}  // namespace tack
