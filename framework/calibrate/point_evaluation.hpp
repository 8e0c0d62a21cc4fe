// An evaluation of one point: values of the fitted parameters, and the residuals of its runs.
//
// A residual is r = sqrt(weight) (run - measured) / s, where s is the noise of the experiment, or
// the largest measured number if the noise is unknown. The misfit is the sum of squared residuals.
#pragma once

#include <limits>
#include <string>
#include <vector>

namespace tack {

using DesignPoint = std::vector<double>;  // a value for each fitted parameter, SI, to six digits

struct PointEvaluation {
  DesignPoint values;
  bool good = false;   // every run finished and passed a measured point
  std::string status;  // "done", or the status of the first run that failed
  std::string error;
  double misfit = std::numeric_limits<double>::infinity();
  std::vector<double> misfits;    // per experiment
  std::vector<double> residuals;  // of the points of all experiments, in order
  // Per experiment: points that its run does not pass, for which the nearest sample counts.
  std::vector<int> beyond;

  bool asked_derivatives = false;  // output.gradients was requested
  // d residuals / d u (fitted_parameter.hpp) for each parameter; empty for parameters without
  // derivatives.
  std::vector<std::vector<double>> derivatives;
};

}  // namespace tack
