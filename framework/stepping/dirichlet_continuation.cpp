#include "framework/stepping/dirichlet_continuation.hpp"

#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/stepping/step_retraction.hpp"
#include "framework/stepping/obstacle.hpp"
#include "framework/stepping/predicted_motion.hpp"

namespace tack {
namespace {

constexpr double pull_strength = 1000;   // K, in mean diagonal stiffnesses of the unknowns
constexpr int max_pulls = 8;             // each ten times stronger
constexpr double close_enough = 0.01;    // of the whole way, from where the last move is tried
constexpr double weak = 0.5;             // a Newton step that brings less of what is pulled at once wants a larger K
constexpr double reached = 0.5;          // of what is pulled at once, from where the next is pulled; what is not cut is pulled to the end
constexpr double much_cut = 0.05;        // a direction of which less is feasible is not taken: a shorter pull gives a better one
constexpr double wanted_cut = 0.5;       // of the longest steps: where they are cut more, less is pulled at once, and more where less
constexpr double far_longer = 4;         // than the step of what is pulled: it is not the pull that makes a direction too long
constexpr int patience = 30;             // iterations without progress before it is given up

double largest_row(const VecX& a, const VecX& b, const std::vector<int>& vertices) {
  double largest = 0;
  for (const int v : vertices) largest = std::max(largest, (vertex(a, v) - vertex(b, v)).norm());
  return largest;
}

// During the continuation, vertices of one rigid group are unknowns of their own. Other bodies stay
// rigid, affine ones too.
class DissolvedGroups {
 public:
  DissolvedGroups(ContactSystem* contact, const std::vector<int>& moving) : contact_(contact) {
    if (contact_) contact_->enable_self_pairs(moving);
  }
  ~DissolvedGroups() {
    if (contact_) contact_->enable_self_pairs({});
  }
  DissolvedGroups(const DissolvedGroups&) = delete;
  DissolvedGroups& operator=(const DissolvedGroups&) = delete;

 private:
  ContactSystem* contact_;
};

}  // namespace

// One run: where to, how far at once, and whether it still gets anywhere.
struct DirichletContinuation::Pull {
  const VecX& goal;          // 3n: the places, and the prediction of all others
  const double whole_way;    // of the vertex that has the longest [m]
  VecX towards = {};         // 3n: a part of the way there
  double length = whole_way; // [m]: of what is pulled at once
  bool whole = true;         // that is all that is left
  double cut = 1;            // the smallest part of a step towards there that was feasible
  bool refused = false;      // one of them was not taken
  bool too_weak = false;     // the last one brought too little
  double best = std::numeric_limits<double>::infinity();  // the smallest distance that was left [m]
  int since_best = 0;        // iterations
  bool stuck = false;

  // From x. Others are led by their inertia along the same part of what they have to go.
  void aim(const VecX& x, const std::vector<int>& vertices) {
    const double left = largest_row(x, goal, vertices);
    length = std::min(length, left);
    whole = length == left;
    towards = x + length / left * (goal - x);
    cut = 1;
    refused = too_weak = false;
  }

  // Returns the fraction of a step to take if `feasible` of it is feasible: 0 if a shorter pull
  // gives a better step, because the pulled vertices' own step is among the longest.
  double take(double feasible, double own_step, double longest_step) {
    if (own_step * far_longer < longest_step) return feasible;
    cut = std::min(cut, feasible);
    if (feasible >= much_cut) return feasible;
    refused = true;
    return 0;
  }

  // Returns a number below 1 if this minimisation may stop. remaining: distance to its targets;
  // left: distance to the final targets [m].
  double norm(double remaining, double left, double next_step) {
    if (left < 0.99 * best) best = left, since_best = 0;
    stuck = ++since_best > patience;
    if (stuck) return 0;
    const double enough = whole && cut >= wanted_cut ? close_enough * whole_way : reached * length;
    const double far = remaining / enough, brought = next_step / (weak * remaining);
    too_weak = far > 1 && brought < 1;
    return std::min(far, brought);
  }

  // After a minimisation.
  void adapt() { length = std::min(std::clamp(cut / wanted_cut, 0.1, 2.0) * length, whole_way); }
};

DirichletContinuation::DirichletContinuation(World& world, const Minimizer& like, PhaseClock& clock, FeasibleSteps& steps)
    : world_(world), minimizer_(like.fresh()), clock_(clock), steps_(steps) {}

void DirichletContinuation::prepare(const VecX& x, const VecX& places) {
  std::vector<int> moving;
  std::vector<char> depends(world_.dofs.vertex_count(), 0);
  for (const int v : world_.dofs.dependents()) depends[v] = 1;
  std::vector<char> partly(world_.dofs.vertex_count(), 0);
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks()) partly[world_.dofs.vertex_of_block(h.block)] = 1;
  for (int v = 0; v < world_.dofs.vertex_count(); ++v)
    if ((!world_.dofs.moves(v) || partly[v]) && !depends[v] && vertex(x, v) != vertex(places, v)) moving.push_back(v);
  if (potential_ && moving == moving_) return;
  moving_ = std::move(moving);
  std::vector<char> unknown(world_.dofs.vertex_count());
  for (size_t v = 0; v < unknown.size(); ++v) unknown[v] = world_.dofs.moves(static_cast<int>(v));
  for (const int v : moving_) unknown[v] = 1;
  dofs_ = DofMap(unknown, world_.dofs.dependences(), held_directions());
  potential_.emplace(world_, clock_, world_.terms, dofs_, world_.mass);
}

// Rollers that do not move keep their directions. Pulled vertices are free, except in directions
// that no motion frees.
std::vector<FixedDirections> DirichletContinuation::held_directions() const {
  std::vector<FixedDirections> held;
  const auto pulled = [&](int v) { return std::binary_search(moving_.begin(), moving_.end(), v); };
  for (const DofMap::PartlyFixedBlock& h : world_.dofs.partly_fixed_blocks())
    if (const int v = world_.dofs.vertex_of_block(h.block); !pulled(v)) held.push_back({v, h.projection, h.scalar});
  for (const FixedDirections& always : world_.prescribed_motion.always_fixed())
    if (pulled(always.vertex)) held.push_back(always);
  return held;
}

VecX DirichletContinuation::masses(double pull, bool inertia) const {
  VecX mass = inertia ? world_.mass : VecX::Zero(world_.mass.size()).eval();
  for (const int v : moving_) mass(v) = pull;
  return mass;
}

// The mean of the Hessian's diagonal without the pull: what K is measured against.
double DirichletContinuation::stiffness(const VecX& x, const TimeIntegrator::Prediction& prediction) {
  VecX q;
  dofs_.gather(x, q);
  potential_->set_mass(masses(0, prediction.inertia));
  potential_->begin_step(x, prediction.x, prediction.scales(), true);
  potential_->move_to(q);
  const BlockMatrix& matrix = potential_->hessian({Projection::clamp});
  double sum = 0;
  for (int c = 0; c < matrix.columns(); ++c) sum += matrix.block(matrix.column_start[c]).trace();
  return sum > 0 ? sum / matrix.size() : 1.0;  // nothing resists: any pull will do
}

void DirichletContinuation::minimize(Pull& pull, Result& result, const MinimizerProblem::Observer& observer) {
  const auto left = [&](const VecX& goal) { return largest_row(potential_->configuration(), goal, moving_); };
  const auto own_step = [&](const VecX& p) {
    double largest = 0;
    for (const int v : moving_) largest = std::max(largest, p.segment<3>(3 * dofs_.block(v)).norm());
    return largest;
  };
  const auto feasible_step = [&](const VecX& q, const VecX& p) {
    const double t = steps_.largest_requested(*potential_, q, p);
    return pull.take(t, own_step(p), p.lpNorm<Eigen::Infinity>());
  };
  const auto norm = [&](const VecX& p, const VecX&) {
    return pull.norm(left(pull.towards), left(pull.goal), own_step(p));
  };
  MinimizerProblem problem{*potential_, feasible_step, norm, clock_};
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

// The last move, to the exact places.
bool DirichletContinuation::arrive(const VecX& places, VecX& x) const {
  VecX last = VecX::Zero(x.size());
  for (const int v : moving_) vertex(last, v) = vertex(places, v) - vertex(x, v);
  dofs_.update_dependents(last);
  if (steps_.largest_requested(x, last) < 1) return false;
  world_.participants.move_to(x);
  if (anything_debonds(world_, x, x + last)) return false;
  for (const int v : moving_) vertex(x, v) = vertex(places, v);
  dofs_.update_dependents(x);
  return true;
}

DirichletContinuation::Result DirichletContinuation::run(const VecX& x, const VecX& places,
                                   const TimeIntegrator::Prediction& prediction,
                                   const MinimizerProblem::Observer& observer) {
  prepare(x, places);
  const DissolvedGroups dissolved(world_.contact.get(), moving_);
  VecX goal = prediction.x;
  for (const int v : moving_) vertex(goal, v) = vertex(places, v);
  Pull pull{goal, largest_row(x, places, moving_)};
  Result result{{}, x, ""};
  double k = pull_strength * stiffness(x, prediction);
  for (int i = 0; i < max_pulls && !pull.stuck;) {
    pull.aim(result.x, moving_);
    potential_->set_mass(masses(k, prediction.inertia));
    potential_->begin_step(result.x, pull.towards, prediction.scales(), true);
    minimize(pull, result, observer);
    if (result.solve.status == MinimizerStatus::interrupted || result.solve.status == MinimizerStatus::time_limit)
      return result;
    if (result.solve.status == MinimizerStatus::iteration_limit) break;
    const bool near = largest_row(result.x, places, moving_) <= close_enough * pull.whole_way;
    if (near && arrive(places, result.x)) {
      result.solve.status = MinimizerStatus::converged;
      return result;
    }
    const bool goes_on = pull.refused || (result.solve.status == MinimizerStatus::converged && !pull.too_weak);
    pull.adapt();
    if (goes_on && !(near && pull.cut >= wanted_cut)) continue;
    k *= 10;
    ++i;
  }
  result.failure = failure(result.x, places);
  return result;
}

std::string DirichletContinuation::failure(const VecX& x, const VecX& places) const {
  int furthest = moving_.front();
  double distance = 0;
  for (const int v : moving_) {
    const double d = (vertex(x, v) - vertex(places, v)).norm();
    if (d > distance) distance = d, furthest = v;
  }
  return describe_obstacle(world_, x, furthest, distance);
}

}  // namespace tack
