// Levenberg-Marquardt steps within bounds, by Ceres.
#pragma once

#include <functional>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct PolishProblem {
  std::vector<double> low, high;
  double tolerance = 1e-3;  // of each unknown
  int iterations = 5;       // most
  // False where there is no value.
  std::function<bool(const std::vector<double>& u, std::vector<double>& residuals)> residuals;
  // d residuals / d u.
  std::function<bool(const std::vector<double>& u, Eigen::MatrixXd& jacobian)> jacobian;
};

// From `start`, at which there are `size` residuals. What it evaluates is kept by those who are asked.
void polish(const PolishProblem& problem, const std::vector<double>& start, int size);

}  // namespace tack
