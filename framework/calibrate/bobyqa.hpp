// Minimisation without derivatives within bounds: BOBYQA (quadratic models, Powell 2009) by NLopt;
// Nelder-Mead simplices for a single unknown.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace tack {

struct BobyqaSettings {
  std::vector<double> low, high;
  double step = 0.15;       // initial step
  double tolerance = 1e-3;  // of each unknown
  int evaluations = 100;    // at most
};

// Minimises `value` from `start`. The search ends when `value` returns nothing.
void bobyqa(const BobyqaSettings& settings, std::vector<double> start,
            const std::function<std::optional<double>(const std::vector<double>&)>& value);

}  // namespace tack
