#include "framework/run/stored_step.hpp"

#include <chrono>
#include <cmath>
#include <ctime>
#include <stdexcept>

#include "framework/config/merged_component.hpp"
#include "framework/experiment/stored_experiment.hpp"
#include "framework/run/reference_solver.hpp"
#include "framework/run/simulation.hpp"

namespace tack {
namespace {

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

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

}  // namespace

StoredStep::StoredStep(std::string path, std::vector<std::string> overrides)
    : path_(std::move(path)), overrides_(std::move(overrides)), file_(read_state_file(path_, StateFile::Kind::problem)) {
  const BuiltExperiment built(load({}));
  check_size(file_, built.world().rest.size() / 3, path_);
  unknowns_ = built.world().dofs.size();
  if (!overrides_.empty()) file_.minimum.resize(0);
}

LoadedExperiment StoredStep::load(const Value& solver) const {
  LoadedExperiment loaded = experiment_of(file_, path_, overrides_);
  loaded.experiment.solver = bind_component<Minimizer>(with_criteria_of_scene(*loaded.experiment.solver, solver));
  loaded.experiment.time.wall_limit.reset();
  return loaded;
}

StoredSolve StoredStep::solve(const Value& solver, StepObservers observers) const {
  Simulation simulation(load(solver));
  simulation.observe(std::move(observers));
  simulation.start_from(file_.state);
  StoredSolve result;
  const auto wall = std::chrono::steady_clock::now();
  const double cpu = cpu_now();
  SolveResult solved = simulation.stepper().solve(file_.step_size);
  result.cpu_seconds = cpu_now() - cpu;
  result.wall_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - wall).count();
  const MinimizerResult& work = solved.minimizer;
  result.status = solved.failure.empty() ? std::string(to_string(work.status)) : solved.failure;
  result.converged = solved.failure.empty() && work.status == MinimizerStatus::converged;
  result.iterations = work.iterations;
  result.evaluations = work.line_search_evaluations;
  result.linear_solves = work.linear_solves;
  result.residual = work.residual;
  if (!solved.failure.empty() || !solved.x.allFinite()) return result;
  result.x = std::move(solved.x);
  if (!has_minimum()) return result;
  const double motion = largest_distance(file_.minimum, file_.state.x);
  result.distance = largest_distance(result.x, file_.minimum) / (motion > 0 ? motion : 1);
  return result;
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
