#include "framework/stepping/dirichlet_continuation.hpp"

#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/stepping/step_retraction.hpp"
#include "framework/stepping/obstacle.hpp"
#include "framework/stepping/predicted_motion.hpp"

namespace tack {
namespace {

constexpr double initial_stiffness_ratio = 1000;  // first K, over the mean diagonal stiffness of the unknowns
constexpr int max_stiffness_raises = 8;           // of K, by a factor of ten each
constexpr double final_fraction = 0.01;           // remaining fraction of the displacement at which the exact targets are tried
constexpr double progress_min = 0.5;              // a Newton step shorter than this fraction of the remaining stage needs a larger K
constexpr double stage_remainder = 0.5;           // remaining fraction of a stage at which the next one begins, if steps are truncated
constexpr double feasible_fraction_min = 0.05;    // directions with a smaller feasible fraction are rejected: a shorter stage gives a better one
constexpr double feasible_fraction_target = 0.5;  // of the longest steps; stages are shortened or extended towards it
constexpr double longest_per_own_step = 4;        // if the longest step is longer than this, it is not caused by the penalty
constexpr int max_idle_iterations = 30;           // without progress

double largest_distance(const VecX& a, const VecX& b, const std::vector<int>& vertices) {
  double largest = 0;
  for (const int v : vertices) largest = std::max(largest, (vertex(a, v) - vertex(b, v)).norm());
  return largest;
}

// Enables collision pairs within the rigid groups of the moving vertices, which are unknowns of their
// own during the continuation. Other bodies stay rigid, affine ones too.
class SelfPairsEnabled {
 public:
  SelfPairsEnabled(ContactSystem* contact, const std::vector<int>& moving) : contact_(contact) {
    if (contact_) contact_->enable_self_pairs(moving);
  }
  ~SelfPairsEnabled() {
    if (contact_) contact_->enable_self_pairs({});
  }
  SelfPairsEnabled(const SelfPairsEnabled&) = delete;
  SelfPairsEnabled& operator=(const SelfPairsEnabled&) = delete;

 private:
  ContactSystem* contact_;
};

}  // namespace

// Stages of a run: each requests a fraction of the remaining displacement.
struct DirichletContinuation::Stage {
  const VecX& goal;      // 3n: final targets; of the other vertices, the prediction
  const double total;    // largest displacement of a prescribed vertex in the run [m]
  VecX target = {};      // 3n: target of the stage
  double length = total; // largest displacement requested by the stage [m]
  bool is_last = true;   // the stage requests all of the remaining displacement
  double smallest_fraction = 1;  // smallest feasible fraction of a step of the stage
  bool rejected = false;         // a step of the stage was rejected
  bool needs_stiffness = false;  // the last step made too little progress
  double best = std::numeric_limits<double>::infinity();  // smallest distance left so far [m]
  int idle_iterations = 0;       // iterations since `best`
  bool stuck = false;

  // Begins a stage at x. Inertia moves the free vertices by the same fraction of their remaining
  // displacement.
  void begin(const VecX& x, const std::vector<int>& vertices) {
    const double left = largest_distance(x, goal, vertices);
    length = std::min(length, left);
    is_last = length == left;
    target = x + length / left * (goal - x);
    smallest_fraction = 1;
    rejected = needs_stiffness = false;
  }

  // Returns the fraction of a step to take if `feasible` of it is feasible. Returns 0 if a shorter
  // stage gives a better step, because the steps of prescribed vertices are among the longest.
  double accepted_fraction(double feasible, double own_step, double longest_step) {
    if (own_step * longest_per_own_step < longest_step) return feasible;
    smallest_fraction = std::min(smallest_fraction, feasible);
    if (feasible >= feasible_fraction_min) return feasible;
    rejected = true;
    return 0;
  }

  // Returns a number below 1 if the minimisation of the stage may end. remaining: distance to the
  // targets of the stage; left: distance to the final targets [m].
  double norm(double remaining, double left, double next_step) {
    if (left < 0.99 * best) best = left, idle_iterations = 0;
    stuck = ++idle_iterations > max_idle_iterations;
    if (stuck) return 0;
    const double enough = is_last && smallest_fraction >= feasible_fraction_target ? final_fraction * total : stage_remainder * length;
    const double distance = remaining / enough, progress = next_step / (progress_min * remaining);
    needs_stiffness = distance > 1 && progress < 1;
    return std::min(distance, progress);
  }

  // Sets the length of the next stage after a minimisation.
  void adapt_length() { length = std::min(std::clamp(smallest_fraction / feasible_fraction_target, 0.1, 2.0) * length, total); }
};

DirichletContinuation::DirichletContinuation(World& world, const Minimizer& like, PhaseClock& clock, FeasibleSteps& steps)
    : world_(world), minimizer_(like.fresh()), clock_(clock), steps_(steps) {}

void DirichletContinuation::prepare(const VecX& x, const VecX& targets) {
  std::vector<int> moving;
  std::vector<char> depends(world_.dofs.vertex_count(), 0);
  for (const int v : world_.dofs.dependents()) depends[v] = 1;
  std::vector<char> partly(world_.dofs.vertex_count(), 0);
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks()) partly[world_.dofs.vertex_of_block(h.block)] = 1;
  for (int v = 0; v < world_.dofs.vertex_count(); ++v)
    if ((!world_.dofs.moves(v) || partly[v]) && !depends[v] && vertex(x, v) != vertex(targets, v)) moving.push_back(v);
  if (potential_ && moving == moving_) return;
  moving_ = std::move(moving);
  std::vector<char> unknown(world_.dofs.vertex_count());
  for (size_t v = 0; v < unknown.size(); ++v) unknown[v] = world_.dofs.moves(static_cast<int>(v));
  for (const int v : moving_) unknown[v] = 1;
  dofs_ = DofMap(unknown, world_.dofs.dependences(), fixed_directions());
  potential_.emplace(world_, clock_, world_.terms, dofs_, world_.mass);
}

// Returns the fixed directions during the continuation: those of vertices that do not move, e.g.
// rollers. Moving vertices are free, except in directions that are fixed for the whole run.
std::vector<FixedDirections> DirichletContinuation::fixed_directions() const {
  std::vector<FixedDirections> fixed;
  const auto moves = [&](int v) { return std::binary_search(moving_.begin(), moving_.end(), v); };
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks())
    if (const int v = world_.dofs.vertex_of_block(h.block); !moves(v)) fixed.push_back({v, h.projection, h.scalar});
  for (const FixedDirections& always : world_.prescribed_motion.always_fixed())
    if (moves(always.vertex)) fixed.push_back(always);
  return fixed;
}

VecX DirichletContinuation::masses(double stiffness, bool inertia) const {
  VecX mass = inertia ? world_.mass : VecX::Zero(world_.mass.size()).eval();
  for (const int v : moving_) mass(v) = stiffness;
  return mass;
}

// Returns the mean diagonal of the Hessian without the penalty, the unit of K.
double DirichletContinuation::stiffness(const VecX& x, const TimeIntegrator::Prediction& prediction) {
  VecX q;
  dofs_.gather(x, q);
  potential_->set_mass(masses(0, prediction.inertia));
  potential_->begin_step(x, prediction.x, prediction.scales(), true);
  potential_->move_to(q);
  const BlockMatrix& matrix = potential_->hessian({Projection::clamp});
  double sum = 0;
  for (int c = 0; c < matrix.columns(); ++c) sum += matrix.block(matrix.column_start[c]).trace();
  return sum > 0 ? sum / matrix.size() : 1.0;  // any K, without resistance
}

void DirichletContinuation::minimize(Stage& stage, Result& result, const MinimizerProblem::Observer& observer) {
  const auto left = [&](const VecX& goal) { return largest_distance(potential_->configuration(), goal, moving_); };
  const auto own_step = [&](const VecX& p) {
    double largest = 0;
    for (const int v : moving_) largest = std::max(largest, p.segment<3>(3 * dofs_.block(v)).norm());
    return largest;
  };
  const auto feasible_step = [&](const VecX& q, const VecX& p) {
    const double t = steps_.largest_requested(*potential_, q, p);
    return stage.accepted_fraction(t, own_step(p), p.lpNorm<Eigen::Infinity>());
  };
  const auto norm = [&](const VecX& p, const VecX&) {
    return stage.norm(left(stage.target), left(stage.goal), own_step(p));
  };
  MinimizerProblem problem{*potential_, {}, norm, clock_};
  steps_.set_feasibility(*potential_, problem);
  problem.feasible_step = feasible_step;
  const MinimizerResult before = result.solve;
  if (observer)
    problem.observer = [&](int iteration, double residual, double value, double seconds) {
      observer(before.iterations + iteration, residual, value, seconds);
    };
  set_retraction(world_, *potential_, problem);
  VecX q;
  dofs_.gather(result.x, q);
  result.solve = minimizer_->minimize(problem, q);
  result.solve.add_work(before);
  dofs_.scatter(q, result.x);
}

// Moves to the exact targets. Returns false if that is blocked or debonds stencils.
bool DirichletContinuation::move_to_targets(const VecX& targets, VecX& x) const {
  VecX last = VecX::Zero(x.size());
  for (const int v : moving_) vertex(last, v) = vertex(targets, v) - vertex(x, v);
  dofs_.update_dependents(last);
  if (steps_.largest_requested(x, last) < 1) return false;
  world_.participants.move_to(x);
  if (anything_debonds(world_, x, x + last)) return false;
  for (const int v : moving_) vertex(x, v) = vertex(targets, v);
  dofs_.update_dependents(x);
  return true;
}

DirichletContinuation::Result DirichletContinuation::run(const VecX& x, const VecX& targets,
                                   const TimeIntegrator::Prediction& prediction,
                                   const MinimizerProblem::Observer& observer) {
  prepare(x, targets);
  const SelfPairsEnabled self_pairs(world_.contact.get(), moving_);
  VecX goal = prediction.x;
  for (const int v : moving_) vertex(goal, v) = vertex(targets, v);
  Stage stage{goal, largest_distance(x, targets, moving_)};
  Result result{{}, x, ""};
  double k = initial_stiffness_ratio * stiffness(x, prediction);
  for (int i = 0; i < max_stiffness_raises && !stage.stuck;) {
    stage.begin(result.x, moving_);
    potential_->set_mass(masses(k, prediction.inertia));
    potential_->begin_step(result.x, stage.target, prediction.scales(), true);
    minimize(stage, result, observer);
    if (result.solve.status == MinimizerStatus::interrupted || result.solve.status == MinimizerStatus::time_limit)
      return result;
    if (result.solve.status == MinimizerStatus::iteration_limit) break;
    const bool near = largest_distance(result.x, targets, moving_) <= final_fraction * stage.total;
    if (near && move_to_targets(targets, result.x)) {
      result.solve.status = MinimizerStatus::converged;
      return result;
    }
    const bool goes_on = stage.rejected || (result.solve.status == MinimizerStatus::converged && !stage.needs_stiffness);
    stage.adapt_length();
    if (goes_on && !(near && stage.smallest_fraction >= feasible_fraction_target)) continue;
    k *= 10;
    ++i;
  }
  result.failure = failure(result.x, targets);
  return result;
}

std::string DirichletContinuation::failure(const VecX& x, const VecX& targets) const {
  int farthest = moving_.front();
  double distance = 0;
  for (const int v : moving_) {
    const double d = (vertex(x, v) - vertex(targets, v)).norm();
    if (d > distance) distance = d, farthest = v;
  }
  return describe_obstacle(world_, x, farthest, distance);
}

}  // namespace tack
