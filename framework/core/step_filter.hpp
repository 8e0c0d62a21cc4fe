// Step filters: bounds of a step by feasibility. No accepted state, intermediate or final, may
// intersect or invert. A solver names its filters (`step_filters`); each applies to a run that has
// objects for it.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/registry.hpp"
#include "framework/core/phase_clock.hpp"
#include "framework/core/step_cuts.hpp"
#include "geometry/types.hpp"

namespace tack {

class ContactSystem;

/// Objects of a world that step filters use.
struct FeasibilityContext {
  ContactSystem* contact;        // null without contact
  const std::vector<Tet>& tets;  // of all solids
  PhaseClock& clock;
};

/// The tightest bound of a step: two primitives (global vertices of each), or a single element.
struct Blocker {
  std::vector<int> first, second;  // empty second: `first` is an element
  double gap = 0;                  // between the two at the start of the step [m]
  double step = 0;                 // the feasible fraction of the step
};

/// A bound of the step size.
class StepFilter : public Component {
 public:
  static constexpr const char* kind_name = "step_filter";
  static constexpr const char* kind_doc = "Bounds a step so that the state stays feasible.";

  /// Attaches the filter to a world; returns false if the world has no objects for it.
  virtual bool attach(const FeasibilityContext& context) = 0;
  /// Returns the largest t in [0, t_max] such that x + s p is feasible for all s in [0, t]. x, p:
  /// all vertices (3n), x feasible. The result is void once the deadline has passed.
  virtual double largest_step(const VecX& x, const VecX& p, double t_max) = 0;
  /// Returns the tightest bound of the step from x to x + p; nothing if the whole step is feasible.
  /// For messages: not fast.
  virtual std::optional<Blocker> blocker(const VecX& x, const VecX& p) = 0;
  /// Returns largest_step() for a p that moves few vertices, at a cost in proportion to their
  /// number; nothing if the filter cannot. moved: the only vertices at which p is not zero,
  /// ascending.
  virtual std::optional<double> largest_local_step(const VecX& /*x*/, const VecX& /*p*/,
                                                   std::span<const int> /*moved*/,
                                                   double /*t_max*/) {
    return std::nullopt;
  }
  /// Appends, in any order, every pair or element that by itself allows less than `below` of the
  /// step from x to x + p; below: in (0, 1]. bodies stay unset. The default appends the tightest.
  virtual void add_cuts(const VecX& x, const VecX& p, double below, std::vector<StepCut>& cuts) {
    const std::optional<Blocker> tightest = blocker(x, p);
    if (!tightest || tightest->step >= below) return;
    cuts.push_back(step_cut(CutKind::other, tightest->first, tightest->second, tightest->step));
  }
  /// Lowers bounds (units.count, at most 1) so that the state stays feasible if every unit makes
  /// any part of its step up to its bound: `together`; or if one makes it and all others rest:
  /// `alone`. Returns false if the filter cannot say.
  virtual bool bound_units(const VecX& /*x*/, const VecX& /*p*/, const MotionUnits& /*units*/,
                           BlockBound /*kind*/, std::vector<double>& /*bounds*/) {
    return false;
  }
  /// Does what bound_units() does `together`, for a p that moves few vertices, at a cost in
  /// proportion to their number. moved: the only vertices at which p is not zero, ascending. The
  /// default is bound_units().
  virtual bool bound_local_units(const VecX& x, const VecX& p, std::span<const int> /*moved*/,
                                 const MotionUnits& units, std::vector<double>& bounds) {
    return bound_units(x, p, units, BlockBound::together, bounds);
  }
};

/// Settings of filters; shared, as minimisers with the same settings have the same filters.
using StepFilters = std::vector<std::shared_ptr<const StepFilter>>;

/// Returns the filters of a solver that names none: ccd and inversion.
StepFilters default_step_filters();

/// Returns a new filter for each of `settings` that attaches to the context.
std::vector<std::unique_ptr<StepFilter>> attached_filters(
    const FeasibilityContext& context, const StepFilters& settings = default_step_filters());

}  // namespace tack
