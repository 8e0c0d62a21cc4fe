// The largest feasible step: no accepted state, intermediate or final, may intersect or invert.
// Every registered filter applies to every run in which it has something to watch.
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

struct FeasibilityContext {
  ContactSystem* contact;        // null without contact
  const std::vector<Tet>& tets;  // of all solids
  PhaseClock& clock;
};

// What bounds a step the most: two primitives (the vertices of each, global), or an element alone.
struct Blocker {
  std::vector<int> first, second;  // empty second: `first` is an element
  double gap = 0;                  // between the two at the start of the step [m]
  double step = 0;                 // the part of the step that is allowed
};

class StepFilter : public Component {
 public:
  static constexpr const char* kind_name = "step_filter";
  static constexpr const char* kind_doc = "Bounds a step so that the state stays feasible.";

  // False if there is nothing to watch.
  virtual bool attach(const FeasibilityContext& context) = 0;
  // The largest t in [0, t_max] such that x + s p is feasible for all s in [0, t], for a feasible x;
  // x and p are configurations of all vertices (3n). When time is out it breaks off, with anything.
  virtual double largest_step(const VecX& x, const VecX& p, double t_max) = 0;
  // What allows no more than that of the step from x to x + p; nothing if all of it is feasible. For
  // messages: not fast.
  virtual std::optional<Blocker> blocker(const VecX& x, const VecX& p) = 0;
};

// One of each kind that has something to watch.
inline std::vector<std::unique_ptr<StepFilter>> attached_filters(const FeasibilityContext& context) {
  std::vector<std::unique_ptr<StepFilter>> filters;
  for (const std::string& name : Registry<StepFilter>::kind().names()) {
    auto filter = Registry<StepFilter>::make(name);
    if (filter->attach(context)) filters.push_back(std::move(filter));
  }
  return filters;
}

}  // namespace tack
