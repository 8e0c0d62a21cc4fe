// Runs the cases of a batch side by side, each in its own process: a crash of one does not affect
// the others.
#pragma once

#include <functional>
#include <list>

#include "framework/batch/case_run.hpp"

namespace tack {

// Callbacks of a running batch.
struct BatchObserver {
  std::function<void(const BatchCase&, const CaseState&)> ended;
  struct Running {
    const BatchCase* one;
    const CaseRun* run;
  };
  // Called several times a second.
  std::function<void(const std::vector<Running>&, size_t waiting)> tick;
};

// Runs each of `cases` once with `program` (a path). Returns early, after interrupting the running
// cases, if an interrupt is requested (geometry/interrupt.hpp). Each state is on disk when its case
// has ended.
void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits,
               const std::vector<const BatchCase*>& cases, const BatchObserver& observer);

// Runs cases that become known during the run. `more` is called several times a second: it appends
// new cases in the order in which they are to start, and returns false when no more will follow.
using MoreCases = std::function<bool(std::list<const BatchCase*>& waiting)>;
void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits,
               const MoreCases& more, const BatchObserver& observer);

// Returns the cases that are still to run: cases without a finished run of the same digest, and
// with `again` the failed cases.
std::vector<const BatchCase*> open_cases(const BatchFolder& folder, const BatchPlan& plan,
                                         bool again);

// Returns the number of cases with `threads` threads and `memory` GB that fit side by side.
int jobs_that_fit(int wanted, int threads, std::optional<double> memory);

}  // namespace tack
