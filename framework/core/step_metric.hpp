// Step metric: a number that a stepper reports of each step. It is a column of steps.csv;
// summary.json has its sum or its maximum. The names of a stepper's metrics never change.
#pragma once

#include <string>

namespace tack {

/// A named number of a step.
struct StepMetric {
  enum class RunValue { sum, maximum };  // value of a run
  std::string name;
  double value = 0;  // SI
  RunValue run_value = RunValue::maximum;
};

}  // namespace tack
