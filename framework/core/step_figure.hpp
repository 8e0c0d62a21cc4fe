// Step metric: a number that a stepper reports of each step. It is a column of steps.csv;
// summary.json has its sum or its maximum. The names of a stepper's metrics never change.
#pragma once

#include <string>

namespace tack {

struct StepFigure {
  enum class Over { sum, most };
  std::string name;
  double value = 0;  // SI
  Over run = Over::most;
};

}  // namespace tack
