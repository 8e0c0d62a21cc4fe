// Stagnation test: whether a minimisation whose steps are below the tolerance continues because of
// force residuals that it does not reduce. A large force on a vertex that hardly moves halves from
// one Newton step to the next, as where a barrier is far too close; a residual that stagnates (in a
// narrow, bent valley, as of wrung cloth) takes hundreds of iterations for micrometres.
#pragma once

#include <algorithm>
#include <array>

namespace tack {

class Stagnation {
 public:
  void begin() { count_ = 0; }

  // Adds an iterate with a step below the tolerance. norm: step over tolerance; residual: force
  // residual over tolerance. Returns true if the last `window` steps sum up to less than the
  // tolerance, and the residual has not fallen to half.
  bool stagnates(double norm, double residual) {
    norms_[count_ % window] = norm;
    residuals_[count_ % window] = residual;
    if (++count_ < window) return false;
    double sum = 0;
    for (const double n : norms_) sum += n;
    const double first = residuals_[count_ % window];
    return sum <= 1 && *std::min_element(residuals_.begin(), residuals_.end()) > enough * first;
  }

 private:
  static constexpr int window = 8;       // iterations
  static constexpr double enough = 0.5;  // fraction of the residual that may be left after them

  std::array<double, window> norms_{}, residuals_{};
  int count_ = 0;
};

}  // namespace tack
