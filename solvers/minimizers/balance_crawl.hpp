// Whether a minimisation whose steps are below the tolerance goes on for forces that it does not bring into balance. A large
// force on what hardly moves halves from one Newton step to the next, as where a barrier is left that is far too close; one
// that crawls (a valley that is narrow and bent, as of wrung cloth) takes hundreds of iterations for micrometres.
#pragma once

#include <algorithm>
#include <array>

namespace tack {

class BalanceCrawl {
 public:
  void begin() { count_ = 0; }

  // Of an iterate that would end the minimisation if forces balanced there: the norm of the step to it and the imbalance, in
  // what is tolerated. True where the last ones together moved by less than the tolerance, and forces did not fall to half.
  bool crawls(double norm, double imbalance) {
    norms_[count_ % window] = norm;
    imbalances_[count_ % window] = imbalance;
    if (++count_ < window) return false;
    double way = 0;
    for (const double n : norms_) way += n;
    const double first = imbalances_[count_ % window];
    return way <= 1 && *std::min_element(imbalances_.begin(), imbalances_.end()) > enough * first;
  }

 private:
  static constexpr int window = 8;         // iterations
  static constexpr double enough = 0.5;  // part of the imbalance that is left after them

  std::array<double, window> norms_{}, imbalances_{};
  int count_ = 0;
};

}  // namespace tack
