// Step filters: bounds of a step by feasibility. No accepted state, intermediate or final, may
// intersect or invert. Every registered filter applies to every run that has objects for it.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "framework/config/registry.hpp"
#include "framework/core/phase_clock.hpp"
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
};

/// Returns one filter of each registered type that attaches to the context.
inline std::vector<std::unique_ptr<StepFilter>> attached_filters(
    const FeasibilityContext& context) {
  std::vector<std::unique_ptr<StepFilter>> filters;
  for (const std::string& name : Registry<StepFilter>::kind().names()) {
    auto filter = Registry<StepFilter>::make(name);
    if (filter->attach(context)) filters.push_back(std::move(filter));
  }
  return filters;
}

}  // namespace tack
