// Interface of minimisers. A minimiser starts from a feasible q, stays in the feasible set, and
// returns a local minimiser of the objective. The stopping norm of the problem, not the method,
// decides on convergence. Failure to converge is a returned status, not an exception.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>

#include "framework/config/registry.hpp"
#include "framework/core/close_pair.hpp"
#include "framework/core/objective.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/core/step_filter.hpp"

namespace tack {

/// Reason why a minimisation ended.
enum class MinimizerStatus {
  converged,           // the stopping norm is below the tolerance
  iteration_limit,     // max_iterations used up
  line_search_failed,  // no step along a descent direction decreases the objective
  blocked,             // the feasible step shrank to nothing
  factorization_failed,
  not_finite,  // value or gradient is not a number
  interrupted,
  time_limit,  // OutOfTime was thrown (deadline.hpp)
};
/// Returns the status in words.
std::string_view to_string(MinimizerStatus status);

/// A problem over some blocks of unknowns, the others held (Objective::restricted).
struct LocalProblem {
  std::unique_ptr<Objective> objective;
  /// The largest t in (0, 1] such that q + s p is feasible for s in [0, t]; q, p: of these blocks.
  std::function<double(const VecX& q, const VecX& p)> feasible_step;
  VecX q;  // of these blocks, where the others are held
  /// Bound of the step of each block, as MinimizerProblem::block_bounds(together). Only of problems
  /// made by MinimizerProblem::locals.
  std::function<VecX(const VecX& q, const VecX& p)> block_bounds = {};
  /// Returns q of these blocks where the problems made along with this one have left them, and
  /// moves the objective there, the others held where they are now. Only of
  /// MinimizerProblem::locals.
  std::function<VecX()> resume = {};
};

/// One problem: objective, feasible steps and convergence criteria.
struct MinimizerProblem {
  Objective& objective;
  /// The largest t in (0, 1] such that q + s p is feasible for s in [0, t].
  std::function<double(const VecX& q, const VecX& p)> feasible_step;
  /// Stopping norm of the last search direction p and the gradient; below 1: converged.
  std::function<double(const VecX& p, const VecX& gradient)> stopping_norm;
  PhaseClock& clock;
  // True if the stopping norm depends on p, which then must be the Newton direction. Methods with
  // another direction use solvers/minimizers/convergence_judge.hpp.
  bool norm_of_direction = true;
  // Observer, optional. Every minimiser calls it in every iteration. residual: the stopping norm as
  // far as it is known; seconds: since the start of the minimisation.
  using Observer =
      std::function<void(int iteration, double residual, double value, double seconds)>;
  Observer observer = {};
  /// Bound of the stopping norm of the exact direction minus that of p, given the residual
  /// r = -g - H p of the Newton system. None: the stopping norm of p counts without correction.
  std::function<double(const VecX& r)> direction_error = {};
  /// Largest force residual, in units of its tolerance. If given, it must be below 1 at the end of
  /// the minimisation.
  std::function<double(const VecX& gradient)> force_residual = {};
  // Retraction on rotations, optional: replaces p by a step from q that agrees with p to first
  // order and rotates stiff bodies without strain. It applies to bodies whose strain energy under p
  // would exceed `loss` [unit of the objective]. Returns false and keeps p if there is no such
  // body.
  std::function<bool(const VecX& q, VecX& p, double loss)> retract = {};
  /// Pairs and elements that by themselves allow less than `below`, in (0, 1], of the step from q
  /// to q + p. Costs a search of all pairs along that part of the step.
  std::function<StepCuts(const VecX& q, const VecX& p, double below)> cuts = {};
  /// Pairs of primitives whose gap at q is below `reach` [m], with closest points and normals,
  /// sorted. Throws InputError if `reach` exceeds the largest range of contact.
  std::function<std::vector<ClosePair>(const VecX& q, double reach)> pairs = {};
  /// Bound of the step of each block (size / 3), in [0, 1]: feasible is any step in which the
  /// blocks make fractions of p up to their bounds, all `together`, or one of them `alone`. Throws
  /// InputError if a step filter knows no such bounds.
  std::function<VecX(const VecX& q, const VecX& p, BlockBound kind)> block_bounds = {};
  /// The problem over some blocks of 3 unknowns (ascending), the others at the objective's current
  /// point. At most one may exist at a time; the objective's point is undefined until its next
  /// move_to().
  std::function<LocalProblem(std::span<const int> blocks)> local = {};
  /// Problems over several sets of blocks (each ascending), to be solved in turn: each has to
  /// resume() before it is used. They begin at the objective's current point, which is undefined
  /// until its next move_to(); after that, they resume there.
  std::function<std::vector<LocalProblem>(std::span<const std::vector<int>> sets)> locals = {};
  /// The unit of motion of each block (step_cuts.hpp): blocks of one unit move a vertex together,
  /// as the four of an affine body do.
  std::function<std::vector<int>()> motion_units = {};
  /// These blocks (ascending) and those that elements and other lasting stencils connect with them.
  std::function<std::vector<int>(std::span<const int> blocks)> with_neighbours = {};
  // True: the observer gets the stopping norm also from methods that must do a linear solve for it
  // alone: in the first 20 iterations, later each time their number has grown by a tenth. Not for
  // timed runs.
  bool true_residuals = false;
};

/// Status and work of a minimisation.
struct MinimizerResult {
  MinimizerStatus status = MinimizerStatus::converged;
  int iterations = 0;
  int linear_solves = 0;
  long linear_iterations = 0;       // of iterative linear solvers
  int line_search_evaluations = 0;  // values in line searches, or in an external minimiser
  double residual = 0;              // the last stopping norm, in units of the tolerance

  /// Adds the work of an earlier minimisation of the same step.
  void add_work(const MinimizerResult& other) {
    iterations += other.iterations;
    linear_solves += other.linear_solves;
    linear_iterations += other.linear_iterations;
    line_search_evaluations += other.line_search_evaluations;
  }
};

/// Returns true if the force residual at the current point of the objective is within its
/// tolerance, or if the problem sets none. Otherwise raises result.residual to the force residual.
bool balanced(const MinimizerProblem& problem, MinimizerResult& result);

/// Convergence criterion.
enum class Stopping {
  velocity,      // |p|_inf / h below a tolerance [m/s], p the Newton direction (the paper)
  force,         // |gradient|_inf below a fraction of the largest force of any stencil
  acceleration,  // |M^-1 gradient|_inf below a tolerance [m/s^2]
};

class Term;

/// A minimisation method with its settings.
class Minimizer : public Component {
 public:
  static constexpr const char* kind_name = "minimizer";
  static constexpr const char* kind_doc = "Minimises the incremental potential of one step.";

  void fields(Fields& f) override;
  Stopping stopping() const { return stopping_; }
  double velocity_tolerance() const { return tolerance_.value_or(0.01); }         // m/s
  double force_tolerance() const { return force_tolerance_; }                     // relative
  double balance_tolerance() const { return balance_tolerance_.value_or(0.01); }  // relative
  std::optional<double> force_floor() const { return force_floor_; }              // N
  double acceleration_tolerance() const { return acceleration_tolerance_; }       // m/s^2

  std::optional<double> time_limit() const { return time_limit_; }  // s of wall time
  bool checks_iterates() const { return check_iterates_; }
  const StepFilters& step_filters() const { return step_filters_; }

  /// Settings that the scene leaves open get defaults in framework/experiment/tolerances.hpp.
  bool tolerance_given() const { return tolerance_.has_value(); }
  bool balance_given() const { return balance_tolerance_.has_value(); }
  void set_velocity_tolerance(double tolerance) { tolerance_ = tolerance; }
  void set_force_floor(double floor) { force_floor_ = floor; }

  /// Returns a minimiser with the settings of this one and no history of earlier minimisations: for
  /// problems beside those of the steps.
  virtual std::unique_ptr<Minimizer> fresh() const;
  /// Names the linear solver and the reason for its choice; "" for methods without linear systems.
  virtual std::string linear_solver() const { return {}; }
  /// Throws InputError if the method cannot minimise a potential of these terms. Called when a
  /// scene is loaded.
  virtual void admit(const std::vector<const Term*>& /*terms*/, int /*unknowns*/) const {}

  /// Minimises. q: in, the feasible start; out, the last feasible iterate. Every call of the
  /// problem may throw OutOfTime, which the method need not catch: only the counts of the work are
  /// lost.
  virtual MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) = 0;

 protected:
  int max_iterations_ = 500;

 private:
  Stopping stopping_ = Stopping::velocity;
  std::optional<double> tolerance_;          // m/s
  std::optional<double> force_floor_;        // N
  std::optional<double> balance_tolerance_;  // relative
  double force_tolerance_ = 1e-4;
  double acceleration_tolerance_ = 1;  // m/s^2
  std::optional<double> time_limit_;   // s
  bool check_iterates_ = false;
  StepFilters step_filters_ = default_step_filters();
};

}  // namespace tack
