// Estimated duration of a batch, from the times of finished cases or from short trials.
#pragma once

#include <map>
#include <string>

#include "framework/batch/batch_run.hpp"

namespace tack {

struct BatchEstimate {
  double seconds = 0;                     // of all open cases, side by side
  std::map<std::string, double> of_case;  // s per case, by base
  // A trial was extended to the whole duration of a case that may end earlier, with its protocols.
  bool at_most = false;
  // Words before and after a time: "at most about", ", if protocols last until time.duration".
  const char* about() const { return at_most ? "at most about" : "about"; }
  const char* condition() const { return at_most ? ", if protocols last until time.duration" : ""; }
};

// Estimates the duration. For each base without a finished case, one case runs for at most `trial`
// seconds; its results are discarded.
BatchEstimate estimate_of(const std::string& program, const BatchFolder& folder,
                          const BatchPlan& plan, const BatchLimits& limits,
                          const std::vector<const BatchCase*>& open, double trial);

}  // namespace tack
