// Runs the cases of a batch side by side. Each is a process of its own: what becomes of one touches no other.
#pragma once

#include <functional>
#include <list>

#include "framework/batch/case_run.hpp"

namespace tack {

// What is told on the way.
struct BatchObserver {
  std::function<void(const BatchCase&, const CaseState&)> ended;
  struct Running {
    const BatchCase* one;
    const CaseRun* run;
  };
  std::function<void(const std::vector<Running>&, size_t waiting)> tick;  // some times a second
};

// Runs `cases` of the plan by `program` (a path), each once. Ends early, with the running ones asked to end, if an interrupt
// is requested (geometry/interrupt.hpp). Each state is on disk when its case has ended.
void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits,
               const std::vector<const BatchCase*>& cases, const BatchObserver& observer);

// The same of cases that are not all known from the start. `more` is asked some times a second: it appends those that have become known, in
// the order in which they are to start, and returns false once no more will come.
using MoreCases = std::function<bool(std::list<const BatchCase*>& waiting)>;
void run_cases(const std::string& program, const BatchFolder& folder, const BatchLimits& limits, const MoreCases& more,
               const BatchObserver& observer);

// The cases that are still to be run: those that never ran to an end as they are now, and with `again` those that failed.
std::vector<const BatchCase*> open_cases(const BatchFolder& folder, const BatchPlan& plan, bool again);

// How many cases of so many threads and GB fit side by side.
int jobs_that_fit(int wanted, int threads, std::optional<double> memory);

}  // namespace tack
