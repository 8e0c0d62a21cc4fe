// A stored step (tack run --dump-problem), minimised by one solver after another: what a study of
// minimisers measures. Each solve has a world of its own, so that no factor or list of candidates
// of an earlier one helps it.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "framework/config/value.hpp"
#include "framework/experiment/load_experiment.hpp"
#include "framework/output/state_file.hpp"
#include "framework/stepping/stepper.hpp"

namespace tack {

/// One solve of a stored step.
struct StoredSolve {
  std::string status;  // "converged", or why not
  bool converged = false;
  int iterations = 0, evaluations = 0;  // of the minimiser, and of its line searches
  int linear_solves = 0;
  double cpu_seconds = 0, wall_seconds = 0;  // of the minimisation alone; cpu: of all threads
  double residual = 0;                       // last stopping norm, in tolerances
  // Stopping norm of the clamped Newton direction at the result, in tolerances
  // (judged_minimizer.hpp).
  std::optional<double> judged_residual;
  // Largest distance of a vertex from the minimum, over the largest displacement of a vertex from
  // the start of the step to the minimum; nothing without a minimum or a result.
  std::optional<double> distance;
  // Incremental potential over that of the minimum [J]; nothing without a minimum or a result.
  std::optional<double> energy_gap;
  int intersections = 0;  // of the result (exact_check.hpp)
  VecX x;                 // 3n [m]; empty without a result
};

/// Settings of a solve beside its solver.
struct StoredSolveSettings {
  // Processor time of the minimisation [s]. With a limit, `max_iterations` limits a solve only if
  // the keys of the solver have it.
  std::optional<double> cpu_limit = std::nullopt;
  double tolerance_scale = 1;  // factor of `tolerance` and `force_tolerance`
  bool judge = false;          // finds StoredSolve::judged_residual
  StepObservers observers = {};
  // Makes the minimiser of the step, in place of the registered one that the keys name; an
  // exception of it leaves solve(). like: that one, with its tolerances.
  std::function<std::unique_ptr<Minimizer>(const Minimizer& like, const World& world)> make_solver =
      {};
};

/// Which minimum a result leads to.
enum class Minimum {
  unknown,  // none is stored, or projected Newton did not converge
  same,     // the stored one
  equal,    // another point of the same potential: free displacement in a quasi-static step
  another,
};
/// Returns the name of the value.
std::string_view to_string(Minimum minimum);

/// A result, checked by projected Newton from there on.
struct StoredCheck {
  Minimum minimum = Minimum::unknown;
  // Largest distance of a vertex from the minimum that the result leads to, over the largest
  // displacement of a vertex in the step: the error of the result.
  std::optional<double> error;
};

class StoredStep {
 public:
  /// Reads a problem file. overrides: of its scene, "a.b=c". Throws InputError.
  explicit StoredStep(std::string path, std::vector<std::string> overrides = {});

  /// Solves the step. solver: a name or a map, laid over the `solver` of the scene; another type
  /// keeps the convergence criteria. Null: the solver of the scene. Throws InputError for a solver
  /// that does not fit.
  StoredSolve solve(const Value& solver, const StoredSolveSettings& settings = {}) const;

  /// Checks a result of solve(). cpu_limit: of the check [s].
  StoredCheck check(const StoredSolve& solved, std::optional<double> cpu_limit = {}) const;

  /// Returns true if the file has a minimum, or find_minimum() found one.
  bool has_minimum() const { return file_.minimum.size() > 0; }
  double minimum_tolerance() const { return file_.minimum_tolerance; }  // m/s
  std::string program() const;                                          // version that stored it
  /// Finds the minimum from the start of the step, by projected Newton with the smallest tolerance
  /// that round-off permits. Returns false if none is found.
  bool find_minimum();
  /// Writes the minimum into the file. Throws std::logic_error without one or with overrides, which
  /// change the problem.
  void store_minimum() const;

  int unknowns() const { return unknowns_; }
  bool quasi_static() const { return quasi_static_; }
  double step_size() const { return file_.step_size; }  // s

 private:
  LoadedExperiment load(const Value& solver) const;
  double motion() const;  // largest displacement of a vertex to the minimum [m]; not 0

  std::string path_;
  std::vector<std::string> overrides_;
  StateFile file_;
  int unknowns_ = 0;
  bool quasi_static_ = false;
  // Of the scene, with its defaults: m/s, relative.
  double velocity_tolerance_ = 0, force_tolerance_ = 0;
};

}  // namespace tack
