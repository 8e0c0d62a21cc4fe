// The points that were measured of an experiment, and what a run makes of them.
#pragma once

#include <string>

#include "framework/calibrate/calibrate_config.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

struct MeasuredPoints {
  std::string name;        // of the experiment
  std::string x, y;        // columns of probes.csv
  std::string x_unit, y_unit;  // SI
  MeasuredCurve curve;
  bool noise_known = false;
  double scale = 1;   // s of point_evaluation.hpp, in the unit of y
  double weight = 1;

  // What the run has at the points; where it does not pass one, what its sample of the nearest abscissa has, and `beyond` counts it. Throws InputError
  // for a run without samples, or without any of the points.
  std::vector<double> simulated(const ProbeSeries& run, int& beyond) const;
  std::vector<double> residuals(const std::vector<double>& simulated) const;
  // What residuals change by with some number, of which dx and dy are the derivatives of the run's x and y at its samples. At a measured x that is dy less
  // the slope of the curve times dx; where the run does not pass the point, dy of the sample that counts.
  std::vector<double> derivatives(const ProbeSeries& run, const std::vector<double>& dx, const std::vector<double>& dy) const;
};

// Throws InputError, with the name of the experiment, for probes that `scene` does not have, a file that cannot be read, another unit than the probe's,
// and measured times at which the run has ended.
MeasuredPoints measured_points(const MeasuredExperiment& experiment, const Experiment& scene);

}  // namespace tack
