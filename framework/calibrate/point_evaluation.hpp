// One choice of the fitted numbers, and how far its runs are from what was measured.
//
// A residual is r = sqrt(weight) (run - measured) / s, with s the noise of the experiment, or the largest measured number where no noise is
// known; a misfit is the sum of its squares.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace tack {

using Point = std::vector<double>;  // a value for each fitted number, SI, to six digits

struct PointEvaluation {
  Point values;
  bool good = false;   // every run came to its end, and passed something that was measured
  std::string status;  // "done", or what became of the first run that did not
  std::string error;
  double misfit = std::numeric_limits<double>::infinity();
  std::vector<double> misfits;    // of each experiment
  std::vector<double> residuals;  // of the points of all experiments, one after the other
  std::vector<int> beyond;        // of each experiment: points that its run does not pass, where its nearest sample counts

  bool asked_derivatives = false;  // its runs had to give them too (output.gradients)
  // d residuals / d u (fitted_number.hpp) for each number; empty of one that they do not give.
  std::vector<std::vector<double>> derivatives;
};

}  // namespace tack
