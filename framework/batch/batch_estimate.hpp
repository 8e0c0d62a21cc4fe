// How long a batch will take, from what is known: the times of cases that ran, or short trials.
#pragma once

#include <map>
#include <string>

#include "framework/batch/batch_run.hpp"

namespace tack {

struct BatchEstimate {
  double seconds = 0;                     // of all open cases, side by side
  std::map<std::string, double> of_case;  // s, by base: of one of its cases
};

// For each base that no case of has run yet, one case is run for at most `trial` seconds and thrown away.
BatchEstimate estimate_of(const std::string& program, const BatchFolder& folder, const BatchPlan& plan, const BatchLimits& limits,
                          const std::vector<const BatchCase*>& open, double trial);

}  // namespace tack
