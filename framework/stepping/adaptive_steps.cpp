#include "framework/stepping/adaptive_steps.hpp"

#include <algorithm>
#include <cmath>

#include "framework/world/body_mass.hpp"

namespace tack {

std::vector<double> abrupt_times(const World& world, double duration) {
  std::vector<double> times;
  const auto add = [&](double t) {
    if (t > 0 && std::isfinite(t)) times.push_back(t);
  };
  for (const PrescribedMotion::Assignment& assignment : world.prescribed_motion.assignments()) {
    add(assignment.motion->from());
    add(assignment.motion->until());
    for (const double t : assignment.motion->corners()) add(t);
  }
  for (const TimedConstraint& timed : world.constraints.timed()) add(timed.from), add(timed.until);
  for (const double t : world.participants.abrupt_times()) add(t);
  add(duration);
  std::sort(times.begin(), times.end());
  return times;
}

StepErrors::StepErrors(const World& world, double tolerance) : world_(world), tolerance_(tolerance) {
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    WeightedVertices body{world.vertices_of(static_cast<int>(i)), {}};
    const double mass = body_mass(world, static_cast<int>(i));
    for (const int v : body.vertices) body.weights.push_back(mass > 0 ? world.gravitational_mass(v) : world.is_scalar_dof(v) ? 0 : 1);
    bodies_.push_back(std::move(body));
  }
}

ErrorRatio StepErrors::measure(const TimeIntegrator::LocalError& error) const {
  double largest = 0;
  for (const WeightedVertices& body : bodies_) {
    double sum = 0, weights = 0;
    for (size_t i = 0; i < body.vertices.size(); ++i) {
      const int v = body.vertices[i];
      if (!world_.dofs.moves(v)) continue;
      sum += body.weights[i] * vertex(error.x, v).squaredNorm();
      weights += body.weights[i];
    }
    if (weights > 0) largest = std::max(largest, std::sqrt(sum / weights));
  }
  return {largest, largest / tolerance_, error.power};
}

}  // namespace tack
