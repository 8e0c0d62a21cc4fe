// A factor over a number: piecewise linear between pairs, constant outside them.
#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "framework/config/piecewise_linear.hpp"

namespace tack {

struct FactorTable {
  std::vector<double> at, factors;  // ascending; as many

  double operator()(double x) const {
    return piecewise_linear(
        at.size(), [&](size_t i) { return at[i]; }, [&](size_t i) { return factors[i]; }, x);
  }
  double largest() const { return *std::max_element(factors.begin(), factors.end()); }
  /// Returns what is wrong with the table, or "". name: of the list `at`.
  std::string error(const std::string& name) const {
    if (at.empty() || at.size() != factors.size()) return "needs as many entries as " + name;
    for (size_t i = 1; i < at.size(); ++i)
      if (!(at[i] > at[i - 1])) return "needs ascending " + name;
    return largest() > 0 ? "" : "needs a number above 0: nothing would adhere at any time";
  }
};

}  // namespace tack
