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

// Speed below which contacts stick.
struct StickingSpeed {
  std::string key;
  double speed;   // m/s
  double finest;  // m/s: the finest tolerance that it asks for by default
};

// Returns the sticking speeds with their keys. step: size of steps [s].
std::vector<StickingSpeed> sticking_speeds(const Experiment& experiment, double step) {
  const ContactConfig& contact = *experiment.contact;
  std::vector<StickingSpeed> speeds;
  const auto add = [&](const std::string& friction, const FrictionConfig& of) {
    if (!of.sticks()) speeds.push_back({friction + ".eps_v", of.full_speed(), finest_sticking});
    else speeds.push_back({friction + ".elastic_slip over time.step,", of.slip_of_stick(contact.contact_distance) / step, 0});
  };
  const auto has_own = [](const ObjectConfig& object) { return object.friction.has_value(); };
  if (contact.friction || std::any_of(experiment.objects.begin(), experiment.objects.end(), has_own)) add("contact.friction", contact.friction.value_or(FrictionConfig()));
  for (size_t i = 0; i < contact.pairs.size(); ++i) {
    const PairConfig& pair = contact.pairs[i];
    const auto key = [&](const char* name) { return fmt::format("contact.pairs[{}].{}", i, name); };
    if (pair.friction) add(key("friction"), *pair.friction);
    if (pair.tangential_adhesion && pair.tangential_adhesion->eps_a)
      speeds.push_back({key("tangential_adhesion.eps_a"), *pair.tangential_adhesion->eps_a, finest_sticking});
  }
  return speeds;
}

double velocity_tolerance(const Experiment& experiment, const World& world) {
  double way = std::min(of_size * smallest_size(world), of_number * smallest_number(world));
  if (experiment.contact) way = std::min(way, of_distance * experiment.contact->contact_distance);
  double speed = way > 0 ? std::min(usual, way / experiment.time.step) : usual;
  if (!experiment.contact) return speed;
  for (const auto& [key, sticking, finest] : sticking_speeds(experiment, experiment.time.step)) speed = std::min(speed, std::max(sticking, finest));
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
  for (const auto& [key, speed, finest] : sticking_speeds(experiment, experiment.time.step))
    if (speed < tolerance * (1 - 1e-9))
      warnings.emplace_back(WarningKind::sticking_speed, fmt::format("{} {:.4g} m/s is below solver.tolerance {:.4g} m/s, so sticking is not resolved; "
                                  "lower the tolerance below it, or raise it", key, speed, tolerance));
  return warnings;
}

}  // namespace tack
