// A minimum without derivatives, by quadratic models within bounds (Powell 2009), by NLopt. Of one unknown, by simplices instead.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace tack {

struct BobyqaSettings {
  std::vector<double> low, high;
  double step = 0.15;       // the first one
  double tolerance = 1e-3;  // of each unknown
  int evaluations = 100;    // most
};

// `value` gives nothing to end the search.
void bobyqa(const BobyqaSettings& settings, std::vector<double> start,
            const std::function<std::optional<double>(const std::vector<double>&)>& value);

}  // namespace tack
