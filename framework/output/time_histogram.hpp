// Histogram of a quantity over a time span of unknown length: bins from 0, whose width doubles
// whenever time exceeds them.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace tack {

struct TimeHistogram {
  double width = 0;  // width of a bin [s]; 0: no data
  std::array<double, 64> sums{};

  void add(double time, double step_size, double amount) {
    if (width == 0) width = step_size;
    while (time > width * sums.size()) widen();
    sums[std::min(static_cast<std::size_t>(time / width), sums.size() - 1)] += amount;
  }
  // Returns the shortest interval [s] whose sum is at least `amount` (at most, if that is
  // negative); the whole time if there is none.
  std::pair<double, double> densest(double amount) const {
    std::size_t from = 0, count = sums.size();
    for (std::size_t i = 0; i < sums.size(); ++i) {
      double sum = 0;
      for (std::size_t k = i; k < sums.size() && k - i + 1 < count; ++k)
        if (sum += sums[k]; amount > 0 ? sum >= amount : sum <= amount) from = i, count = k - i + 1;
    }
    return {from * width, (from + count) * width};
  }

 private:
  void widen() {
    for (std::size_t i = 0; i < sums.size(); ++i)
      sums[i] = 2 * i < sums.size() ? sums[2 * i] + sums[2 * i + 1] : 0;
    width *= 2;
  }
};

}  // namespace tack
