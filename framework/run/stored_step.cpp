#include "framework/run/stored_step.hpp"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <stdexcept>

#include "framework/config/merged_component.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "framework/run/cpu_limit.hpp"
#include "framework/run/exact_check.hpp"
#include "framework/run/judged_minimizer.hpp"
#include "framework/run/reference_solver.hpp"
#include "framework/run/simulation.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Distances of two solutions of a step that count as one, over the displacement in the step, and
// relative differences of their potentials.
constexpr double same_distance = 1e-4, same_potential = 1e-9;
constexpr int unlimited_iterations = 1'000'000;

// Returns the keys of a solver that is laid over the scene's. Another type of solver keeps the
// convergence criteria of the scene unless it states its own.
Value with_criteria_of_scene(const Minimizer& of_scene, const Value& over) {
  Value value = merged_component(&of_scene, over);
  const Value own = to_value(&of_scene);
  for (const char* key : {"stopping", "tolerance", "force_tolerance", "balance_tolerance", "force_floor", "acceleration_tolerance"})
    if (const Value* criterion = own.find(key); criterion && !criterion->is_null() && !value.find(key)) value.set(key, *criterion);
  return value;
}

double largest_distance(const VecX& a, const VecX& b) {
  return std::sqrt(Eigen::Matrix3Xd((a - b).reshaped(3, a.size() / 3)).colwise().squaredNorm().maxCoeff());
}

// Returns whether an unknown differs between two configurations. A solve that ends before its minimisation has prescribed vertices at their targets and all
// others at the start: no state of the step.
bool moves_unknowns(const World& world, const VecX& from, const VecX& to) {
  VecX before, after;
  world.dofs.gather(from, before);
  world.dofs.gather(to, after);
  return before != after;
}

}  // namespace

StoredStep::StoredStep(std::string path, std::vector<std::string> overrides)
    : path_(std::move(path)), overrides_(std::move(overrides)), file_(read_state_file(path_, StateFile::Kind::problem)) {
  const BuiltExperiment built(load({}));
  check_size(file_, built.world().rest.size() / 3, path_);
  unknowns_ = built.world().dofs.size();
  const Experiment& experiment = built.experiment();
  quasi_static_ = !experiment.time.integrator->inertia();
  velocity_tolerance_ = experiment.solver->velocity_tolerance();
  force_tolerance_ = experiment.solver->force_tolerance();
  if (!overrides_.empty()) file_.minimum.resize(0);
}

LoadedExperiment StoredStep::load(const Value& solver) const {
  LoadedExperiment loaded = experiment_of(file_, path_, overrides_);
  loaded.experiment.solver = bind_component<Minimizer>(with_criteria_of_scene(*loaded.experiment.solver, solver));
  loaded.experiment.time.wall_limit.reset();
  return loaded;
}

std::string StoredStep::program() const { return file_.commit.empty() ? file_.program : file_.program + " (" + file_.commit + ")"; }

double StoredStep::motion() const {
  const double motion = largest_distance(file_.minimum, file_.state.x);
  return motion > 0 ? motion : 1;
}

StoredSolve StoredStep::solve(const Value& solver, const StoredSolveSettings& settings) const {
  Value keys = solver;
  const auto set_key = [&](const char* key, Value value) {
    if (!keys.is_map()) {
      const Value type = keys;
      keys = Value::map();
      if (!type.is_null()) keys.set("type", type);
    }
    keys.set(key, std::move(value));
  };
  if (settings.cpu_limit && !solver.find("max_iterations")) set_key("max_iterations", Value::number(unlimited_iterations));
  if (settings.tolerance_scale != 1) {
    const std::unique_ptr<const Minimizer> own = bind_component<Minimizer>(with_criteria_of_scene(*load({}).experiment.solver, solver));
    set_key("tolerance", Value::number(settings.tolerance_scale * (own->tolerance_given() ? own->velocity_tolerance() : velocity_tolerance_)));
    set_key("force_tolerance", Value::number(settings.tolerance_scale * own->force_tolerance()));
  }
  Simulation simulation(load(keys));
  Judgement judgement;
  if (settings.make_solver)
    simulation.solve_with(
        [&] { return settings.make_solver(*simulation.experiment().solver, simulation.world()); });
  else if (settings.judge)
    simulation.solve_with(
        [&] { return judged(instance_of(*simulation.experiment().solver), judgement); });
  simulation.observe(settings.observers);
  simulation.start_from(file_.state);
  StoredSolve result;
  SolveResult solved;
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_now();
  bool out_of_time = false;
  try {
    const CpuLimit limit(settings.cpu_limit);
    solved = simulation.stepper().solve(file_.step_size);
    out_of_time = limit.passed();
  } catch (const SimulationError& error) {
    if (settings.make_solver) throw;
    solved.failure = error.what();
  }
  result.cpu_seconds = cpu_now() - cpu - judgement.cpu_seconds;
  result.judged_residual = judgement.residual;
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count() - judgement.wall_seconds;
  const MinimizerResult& work = solved.minimizer;
  const MinimizerStatus status = out_of_time && work.status == MinimizerStatus::interrupted ? MinimizerStatus::time_limit : work.status;
  if (out_of_time && status != MinimizerStatus::converged) result.status = fmt::format("out of processor time (cpu limit: {:g} s)", *settings.cpu_limit);
  else result.status = solved.failure.empty() ? status_text(solved) : solved.failure;
  result.converged = solved.failure.empty() && status == MinimizerStatus::converged;
  result.iterations = work.iterations;
  result.evaluations = work.line_search_evaluations;
  result.linear_solves = work.linear_solves;
  result.residual = work.residual;
  if (!solved.failure.empty() || !solved.x.allFinite()) return result;
  if (!result.converged && !moves_unknowns(simulation.world(), file_.state.x, solved.x)) return result;
  result.x = std::move(solved.x);
  result.intersections = intersections_at(simulation.world(), result.x);
  if (!has_minimum()) return result;
  result.distance = largest_distance(result.x, file_.minimum) / motion();
  TimeStepper& stepper = simulation.stepper();
  result.energy_gap = stepper.potential_at(result.x) - stepper.potential_at(file_.minimum);
  return result;
}

StoredCheck StoredStep::check(const StoredSolve& solved, std::optional<double> cpu_limit) const {
  StoredCheck check;
  if (!has_minimum() || solved.x.size() == 0 || solved.intersections > 0) return check;
  Value solver = reference_solver("clamp", "lagged_cholesky", minimum_tolerance());
  solver.set("tolerance", Value::number(minimum_tolerance()));
  Simulation simulation(load(solver));
  simulation.start_from(file_.state);
  SolveResult refined;
  {
    const CpuLimit limit(cpu_limit);
    refined = simulation.stepper().solve(file_.step_size, &solved.x);
  }
  if (!refined.failure.empty() || refined.minimizer.status != MinimizerStatus::converged) return check;
  check.error = largest_distance(solved.x, refined.x) / motion();
  if (largest_distance(refined.x, file_.minimum) <= same_distance * motion()) {
    check.minimum = Minimum::same;
    return check;
  }
  TimeStepper& stepper = simulation.stepper();
  const double own = stepper.potential_at(refined.x), stored = stepper.potential_at(file_.minimum);
  check.minimum = std::abs(own - stored) <= same_potential * std::abs(stored) ? Minimum::equal : Minimum::another;
  return check;
}

std::string_view to_string(Minimum minimum) {
  switch (minimum) {
    case Minimum::unknown: return "";
    case Minimum::same: return "same";
    case Minimum::equal: return "equal";
    case Minimum::another: return "another";
  }
  return "";
}

bool StoredStep::find_minimum() {
  for (double tolerance = reference_tolerance_min; tolerance <= reference_tolerance_max * (1 + 1e-9); tolerance *= 10)
    for (const char* linear : {"lagged_cholesky", "cholmod"}) {
      Value solver = reference_solver("clamp", linear, tolerance);
      solver.set("tolerance", Value::number(tolerance));
      StoredSolve solved = solve(solver);
      if (!solved.converged) continue;
      file_.minimum = std::move(solved.x);
      file_.minimum_tolerance = tolerance;
      return true;
    }
  return false;
}

void StoredStep::store_minimum() const {
  if (!has_minimum() || !overrides_.empty()) throw std::logic_error("only the minimum of the problem as it is stored can be stored");
  write_state_file(path_, file_);
}

}  // namespace tack
