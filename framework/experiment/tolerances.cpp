#include "framework/experiment/tolerances.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "framework/body/extent.hpp"
#include "framework/config/bind.hpp"

namespace tack {
namespace {

constexpr double usual = 0.01;           // m/s: 1 cm/s
constexpr double of_distance = 0.1;      // of the contact distance: admissible error of a step
constexpr double of_size = 1e-3;         // of the smallest moving object
// Fraction of the unit of a scalar dof, for example of a radian.
constexpr double of_number = 1e-2;
// m/s: sticking speeds below are not resolved unless a tolerance asks for it.
constexpr double finest_sticking = 1e-4;

// Returns the diagonal of the smallest moving object [m]; the diameter of a single particle.
double smallest_size(const World& world) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const Body& body : world.bodies)
    if (body.movable) smallest = std::min(smallest, extent_of(body, world.rest).diagonal().norm() + 2 * body.radius);
  return smallest;
}

// Returns the smallest displacement [m] that a unit of a scalar dof causes: a radian of a rod's
// twist moves its surface by the radius of gyration.
double smallest_number(const World& world) {
  double smallest = std::numeric_limits<double>::infinity();
  for (const UnknownGroup& group : world.unknowns)
    if (group.length > 0 && (group.body < 0 || world.bodies[group.body].movable)) smallest = std::min(smallest, group.length);
  return smallest;
}

// Returns the sticking speeds with their keys.
std::vector<std::pair<std::string, double>> sticking_speeds(const ContactConfig& contact) {
  std::vector<std::pair<std::string, double>> speeds;
  if (contact.friction) speeds.emplace_back("contact.friction.eps_v", contact.friction->eps_v);
  for (size_t i = 0; i < contact.pairs.size(); ++i) {
    const PairConfig& pair = contact.pairs[i];
    const auto key = [&](const char* name) { return fmt::format("contact.pairs[{}].{}", i, name); };
    if (pair.friction) speeds.emplace_back(key("friction.eps_v"), pair.friction->eps_v);
    if (pair.tangential_adhesion && pair.tangential_adhesion->eps_a)
      speeds.emplace_back(key("tangential_adhesion.eps_a"), *pair.tangential_adhesion->eps_a);
  }
  return speeds;
}

double velocity_tolerance(const Experiment& experiment, const World& world) {
  double way = std::min(of_size * smallest_size(world), of_number * smallest_number(world));
  if (experiment.contact) way = std::min(way, of_distance * experiment.contact->contact_distance);
  double speed = way > 0 ? std::min(usual, way / experiment.time.step) : usual;
  if (!experiment.contact) return speed;
  for (const auto& [key, sticking] : sticking_speeds(*experiment.contact)) speed = std::min(speed, std::max(sticking, finest_sticking));
  return speed;
}

}  // namespace

std::unique_ptr<const Minimizer> solver_with_tolerances(const Experiment& experiment, const World& world) {
  auto solver = instance_of(*experiment.solver);
  if (!solver->tolerance_given()) solver->set_velocity_tolerance(velocity_tolerance(experiment, world));
  return solver;
}

std::vector<Warning> tolerance_warnings(const Experiment& experiment) {
  std::vector<Warning> warnings;
  if (!experiment.contact || !experiment.time.integrator->inertia() || experiment.solver->stopping() != Stopping::velocity) return warnings;
  const double tolerance = experiment.solver->velocity_tolerance(), way = tolerance * experiment.time.step;
  const double distance = experiment.contact->contact_distance;
  if (way > of_distance * distance * (1 + 1e-9))
    warnings.emplace_back(WarningKind::solver_tolerance, fmt::format(
        "solver.tolerance {:.4g} m/s lets a step of {:.4g} s end {:.4g} m off, and the contact distance is {:.4g} m; "
        "lower solver.tolerance to {:.4g} m/s or less", tolerance, experiment.time.step, way, distance,
        of_distance * distance / experiment.time.step));
  for (const auto& [key, speed] : sticking_speeds(*experiment.contact))
    if (speed < tolerance * (1 - 1e-9))
      warnings.emplace_back(WarningKind::sticking_speed, fmt::format("{} {:.4g} m/s is below solver.tolerance {:.4g} m/s, so sticking is not resolved; "
                                  "lower the tolerance below it, or raise it", key, speed, tolerance));
  return warnings;
}

}  // namespace tack
