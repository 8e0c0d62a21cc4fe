#include "framework/stepping/feasible_steps.hpp"

#include "framework/stepping/obstacle.hpp"

namespace tack {

FeasibleSteps::FeasibleSteps(World& world, PhaseClock& clock, IterateCheck* check)
    : world_(world), clock_(clock), check_(check), filters_(attached_filters({world.contact.get(), world.tets, clock})) {}

double FeasibleSteps::largest(const VecX& x, const VecX& p) {
  if (check_) check_->check(x);
  double t = 1;
  for (const auto& filter : filters_) {
    clock_.deadline().check();
    t = filter->largest_step(x, p, t);
  }
  clock_.deadline().check();
  return t;
}

double FeasibleSteps::largest_requested(const VecX& x, const VecX& p) {
  x_ = x;
  p_ = p;
  const double feasible = largest(x_, p_);
  if (observer_) observer_(x_, p_, feasible);
  return feasible;
}

double FeasibleSteps::largest_requested(const StepPotential& potential, const VecX& q, const VecX& p) {
  VecX x = potential.configuration(), displacement = VecX::Zero(x.size());
  potential.dofs().scatter(q, x);
  potential.dofs().scatter(p, displacement);
  return largest_requested(x, displacement);
}

std::string FeasibleSteps::blocker() const {
  if (x_.size() == 0) return "";
  const std::string description = describe_blocker(world_, filters_, x_, p_);
  return description.empty() ? "" : "; the last step was " + description;
}

}  // namespace tack
