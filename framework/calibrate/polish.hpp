// Levenberg-Marquardt steps within bounds, by Ceres.
#pragma once

#include <functional>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct PolishProblem {
  std::vector<double> low, high;
  double tolerance = 1e-3;  // of each unknown
  int iterations = 5;       // at most
  // Computes the residuals; returns false if they do not exist at u.
  std::function<bool(const std::vector<double>& u, std::vector<double>& residuals)> residuals;
  // Computes d residuals / d u; returns false if it does not exist at u.
  std::function<bool(const std::vector<double>& u, Eigen::MatrixXd& jacobian)> jacobian;
};

// Minimises from `start`. `size`: number of residuals. The caller's functions record the evaluated
// points.
void polish(const PolishProblem& problem, const std::vector<double>& start, int size);

}  // namespace tack
