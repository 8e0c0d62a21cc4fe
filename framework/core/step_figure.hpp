// A number that a stepper tells of each step, always under the same names: a column of steps.csv, and in summary.json the sum or the most of it.
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
