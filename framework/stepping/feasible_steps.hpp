// Feasible step sizes: the largest step that all step filters allow. The last requested step is
// stored for messages.
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "framework/core/minimizer.hpp"
#include "framework/core/step_filter.hpp"
#include "framework/stepping/iterate_check.hpp"
#include "framework/world/step_potential.hpp"

namespace tack {

class LocalPotential;

// Fraction of a feasible step that prescribed motion and path following take: all of it would
// leave no gap.
inline constexpr double usable_fraction = 0.9;

class FeasibleSteps {
 public:
  // Makes the filters that apply to the world. check: is given every state from which a step is
  // requested; may be null.
  FeasibleSteps(World& world, PhaseClock& clock, IterateCheck* check = nullptr,
                const StepFilters& filters = default_step_filters());

  // Returns the largest t in (0, 1] such that x + s p (3n) is feasible for s in [0, t]. Throws
  // OutOfTime.
  double largest(const VecX& x, const VecX& p);
  // Returns largest() for a step that a minimiser requests, and notifies the observer.
  double largest_requested(const VecX& x, const VecX& p);
  // Overload for q and p over the unknowns of the potential, whose configuration supplies all other
  // vertices.
  double largest_requested(const StepPotential& potential, const VecX& q, const VecX& p);
  // Sets feasible_step, pairs, cuts, block_bounds, local, locals, motion_units and with_neighbours
  // of a problem over the unknowns of the potential. Both must outlive the problem.
  void set_feasibility(StepPotential& potential, MinimizerProblem& problem);
  // See MinimizerProblem::cuts and block_bounds.
  StepCuts cuts(const StepPotential& potential, const VecX& q, const VecX& p, double below);
  VecX block_bounds(const StepPotential& potential, const VecX& q, const VecX& p, BlockBound kind);
  // Returns bounds of blocks for a step of a local potential, at the cost of its region. units: of
  // the whole potential.
  VecX local_bounds(LocalPotential& potential, const VecX& q, const VecX& p,
                    const MotionUnits& units);
  // Returns largest() for a step of a local potential, at the cost of its region.
  double largest_local(LocalPotential& potential, const VecX& q, const VecX& p);
  // Clears the last requested step.
  void reset() { x_.resize(0); }
  // Returns "; the last step was ..." with the primitive that truncated the last requested step, or
  // "".
  std::string blocker() const;

  using Observer = std::function<void(const VecX& x, const VecX& p, double feasible)>;
  void observe(Observer observer) { observer_ = std::move(observer); }

  // Returns the units of motion. Blocks that move one vertex together are one unit, and so are all
  // blocks of a tetrahedron of which one unit moves two corners: see solvers/filters/inversion.cpp.
  MotionUnits units(const DofMap& dofs) const;

 private:
  // Returns largest() for the stored step, and notifies the observer.
  double largest_of_stored();

  World& world_;
  PhaseClock& clock_;
  IterateCheck* check_;
  std::vector<std::unique_ptr<StepFilter>> filters_;
  std::vector<double> unit_bounds_;  // 1 between calls
  VecX x_, p_;                       // last requested step (3n); x_ is empty before the first one
  Observer observer_;
};

}  // namespace tack
