// Profiler of a run. Terms are timed at every evaluation, phases by the clock of the run. The time
// of contact is divided among the pairs of objects in proportion to their times alone
// (isolated_pair.hpp), measured at the end of a step after ten or more iterations. The profiler
// only reads the state: a profiled run has the bits of an unprofiled one. Its own time is in no
// phase.
#pragma once

#include <map>
#include <optional>

#include "framework/core/minimizer.hpp"
#include "framework/output/summary.hpp"
#include "framework/profile/loop_profiler.hpp"
#include "framework/profile/profile.hpp"
#include "framework/world/world.hpp"

namespace tack {

class Profiler {
 public:
  // `solver`: as specified. All three must outlive it. contact_distance: the scene's [m]; 0:
  // without contact. cores: numbers of cores to predict for, the first is the one to explain;
  // empty: none.
  Profiler(const World& world, const Minimizer& solver, PhaseClock& clock, double contact_distance,
           const std::vector<int>& cores);
  ~Profiler() { clock_.time_terms(nullptr); }
  Profiler(const Profiler&) = delete;
  Profiler& operator=(const Profiler&) = delete;

  // Records a step from x to x + p (3n) of which the fraction `feasible` is allowed.
  void tried(const VecX& x, const VecX& p, double feasible);
  // Records the state after an accepted step.
  void step(const State& state, const StepReport& report);
  // Ends the profile; moves the contact system of the run. state: the last one.
  Profile finish(const State& state, const RunSummary& summary);

 private:
  // Excludes the lifetime of a scope from phases and loops.
  class Pause {
   public:
    explicit Pause(Profiler& profiler)
        : loops_(profiler.loops_ ? &*profiler.loops_ : nullptr), clock_(profiler.clock_) {}

   private:
    LoopProfiler::Pause loops_;
    ClockPause clock_;
  };
  struct CutStep {
    VecX x, p;  // 3n; empty: nothing was cut
    double feasible = 1;
  };
  struct Hard {
    HardStep step;
    CutStep cut;
  };

  ContactSeconds contact_seconds() const;
  void charge_pairs(const State& state);
  void store_if_hard(const StepReport& report);
  std::vector<TermCost> terms() const;
  std::vector<PairCost> pairs() const;
  std::vector<ContactRange> contact_ranges() const;
  std::vector<HardStep> hardest();
  LinearCost linear(const RunSummary& summary) const;

  const World& world_;
  const Minimizer& solver_;
  PhaseClock& clock_;
  double contact_distance_;  // m
  TermTimes times_;
  struct Pair {
    PairCount count;
    int touching_steps = 0;
    ContactSeconds seconds;
  };
  std::map<ObjectIds, Pair> pairs_;
  ContactSeconds charged_;        // contact times at the last call of charge_pairs
  ContactSeconds uncharged_;      // contact times of no pair
  int uncharged_iterations_ = 0;  // since that call
  TruncatedSteps cuts_;
  CutStep cut_;  // the most truncated one of the present step
  std::vector<Hard> hardest_;
  Profile totals_;
  std::optional<LoopProfiler> loops_;
};

}  // namespace tack
