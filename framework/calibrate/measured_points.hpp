// The measured points of an experiment, and their counterparts in a run.
#pragma once

#include <string>

#include "framework/calibrate/calibrate_config.hpp"
#include "framework/experiment/experiment.hpp"
#include "framework/output/probes_csv.hpp"

namespace tack {

struct MeasuredPoints {
  std::string name;            // of the experiment
  std::string x, y;            // columns of probes.csv
  std::string x_unit, y_unit;  // SI
  MeasuredCurve curve;
  bool noise_known = false;
  double scale = 1;  // s of point_evaluation.hpp, in the unit of y
  double weight = 1;

  // Returns the run's y at each measured point. For points that the run does not pass, takes the
  // sample with the nearest x and counts them in `beyond`. Throws InputError for a run without
  // samples or without any of the points.
  std::vector<double> simulated(const ProbeSeries& run, int& beyond) const;
  std::vector<double> residuals(const std::vector<double>& simulated) const;
  // Returns d residuals / d number. dx, dy: derivatives of the run's x and y at its samples.
  // - at a measured x: dy - (slope of the curve) dx
  // - where the run does not pass the point: dy of the nearest sample
  std::vector<double> derivatives(const ProbeSeries& run, const std::vector<double>& dx,
                                  const std::vector<double>& dy) const;
};

// Reads the measured points. Throws InputError, with the name of the experiment, for unknown probes
// of `scene`, an unreadable file, a unit that differs from the probe's, and measured times after
// the end of the run.
MeasuredPoints measured_points(const MeasuredExperiment& experiment, const Experiment& scene);

}  // namespace tack
