// Errors of adaptive steps (time.adaptive), and times at which they end. A formula of another order
// measures a step (TimeIntegrator::local_error):
//     e = max over bodies of sqrt(sum m |e_i|^2 / sum m)  [m],  i: the moving vertices of the body.
// Weighting by mass (for a body without mass: by vertices) makes e a mean over the body that does
// not depend on the mesh. The maximum over bodies keeps a large body from hiding a small one.
#pragma once

#include <vector>

#include "framework/stepping/step_size.hpp"
#include "framework/stepping/time_integrator.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns the times of abrupt changes of prescribed motions, constraints and loads, and the end of
// the run, ascending [s].
std::vector<double> abrupt_times(const World& world, double duration);

class StepErrors {
 public:
  // tolerance: time.adaptive.error [m].
  StepErrors(const World& world, double tolerance);
  ErrorRatio measure(const TimeIntegrator::LocalError& error) const;

 private:
  struct WeightedVertices {
    std::vector<int> vertices;
    std::vector<double> weights;
  };

  const World& world_;
  double tolerance_;
  std::vector<WeightedVertices> bodies_;
};

}  // namespace tack
