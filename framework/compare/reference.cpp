#include "framework/compare/reference.hpp"

#include <cmath>
#include <limits>

#include "framework/config/parse.hpp"
#include "framework/run/reference_solver.hpp"

namespace tack {
namespace {

// Relative to the size of the moving objects: solutions at a larger distance are different.
constexpr double same_minimum = 1e-6;
constexpr double same_potential = 1e-9;  // relative

// Turns off adaptive steps.
Value fixed_steps() { return parse_string("adaptive: null\n", "(reference)"); }

template <class Act>
void for_each_movable(const World& world, const Act& act) {
  for (int v = 0; v < static_cast<int>(world.rest.size()) / 3; ++v)
    if (world.prescribed_motion.ever_free(v)) act(v);
}

// Returns true if x has the potential of the trial's own solution of the same single step.
bool equal_potential(Trial& trial, const VecX& x) {
  const double here = trial.potential_at(x), there = trial.potential_at(trial.result().x);
  return std::abs(here - there) <= same_potential * std::abs(there);
}

// Returns the distance up to which two solutions count as one [m].
double same_branch_distance(const CompareCase& compare_case) {
  return compare_case.size * (compare_case.single() ? same_minimum : compare_case.branch_distance);
}

}  // namespace

double largest_distance(const World& world, const VecX& a, const VecX& b) {
  double largest = 0;
  for_each_movable(world, [&](int v) { largest = std::max(largest, (vertex(a, v) - vertex(b, v)).norm()); });
  return largest;
}

double rms_distance(const World& world, const VecX& a, const VecX& b) {
  double sum = 0;
  int count = 0;
  for_each_movable(world, [&](int v) { sum += (vertex(a, v) - vertex(b, v)).squaredNorm(), ++count; });
  return std::sqrt(sum / std::max(count, 1));
}

Reference make_reference(const CompareCase& compare_case, double step_size, double tolerance, double largest) {
  Reference reference;
  const auto solve = [&](const char* projection, const char* linear, double to) {
    auto trial = std::make_unique<Trial>(compare_case, TrialSettings{reference_solver(projection, linear, to), to, step_size, {}, fixed_steps()});
    reference.status = trial->run().status;
    return trial;
  };
  for (double to = tolerance; to <= largest * (1 + 1e-9) && !reference.exists(); to *= 10) {
    auto trial = solve("clamp", "lagged_cholesky", to);
    if (!trial->result().converged) trial = solve("clamp", "cholmod", to);
    if (!trial->result().converged) continue;
    reference.trial = std::move(trial);
    reference.tolerance = to;
  }
  if (!reference.exists()) return reference;
  reference.disagreement = reference.floor = std::numeric_limits<double>::quiet_NaN();
  const auto second = solve("absolute", "cholmod", reference.tolerance);
  if (!second->result().converged) return reference;
  const Trial& first = *reference.trial;
  reference.disagreement = largest_distance(first.world(), first.result().x, second->result().x);
  const bool equal = compare_case.single() && equal_potential(*reference.trial, second->result().x);
  // A single step is measured from the minimum that it found, as for the compared solvers.
  reference.floor = rms_distance(first.world(), second->result().x, branch_of(compare_case, reference, step_size, second->result().x).x);
  reference.other_branch = reference.disagreement > same_branch_distance(compare_case) && !equal;
  return reference;
}

Branch branch_of(const CompareCase& compare_case, const Reference& reference, double step_size, const VecX& x) {
  Trial& first = *reference.trial;
  const VecX& exact = first.result().x;
  const auto near = [&](const VecX& y) { return largest_distance(first.world(), exact, y) <= same_branch_distance(compare_case); };
  if (!compare_case.single()) return {near(x) ? Branch::Kind::same : Branch::Kind::another, exact};
  Trial refined(compare_case, {reference_solver("clamp", "lagged_cholesky", reference.tolerance), reference.tolerance, step_size});
  if (!refined.run(&x).complete) return {Branch::Kind::another, exact};
  const VecX& own = refined.result().x;
  if (near(own)) return {Branch::Kind::same, exact};
  return {equal_potential(first, own) ? Branch::Kind::equal : Branch::Kind::another, own};
}

}  // namespace tack
