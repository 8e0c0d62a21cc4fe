#include "framework/experiment/time_scales.hpp"

#include <fmt/format.h>

#include <cmath>

#include "framework/body/extent.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/world/body_mass.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {

std::string time_text(double seconds) {
  const char* unit = "s";
  double factor = 1;
  for (const auto& [smaller, name] : {std::pair{1e-3, "ms"}, {1e-6, "us"}, {1e-9, "ns"}}) {
    if (seconds >= factor || seconds == 0) break;
    factor = smaller;
    unit = name;
  }
  return fmt::format("{:.4g} {}", seconds / factor, unit);
}

std::string steps_text(const Experiment& experiment) {
  const TimeConfig& time = experiment.time;
  const char* most = experiment.protocols.empty() ? "" : "at most ";
  if (time.adaptive) return fmt::format("steps of {} to {}, {}to {}", time_text(time.smallest_step()), time_text(time.largest_step()), most, time_text(time.duration));
  return fmt::format("{}{:.0f} steps of {}, to {}", most, std::ceil(time.duration / time.step * (1 - 1e-9)), time_text(time.step), time_text(time.duration));
}

std::optional<double> wave_time(const Experiment& experiment, const World& world, int body) {
  const Body& b = world.bodies[static_cast<size_t>(body)];
  if (!experiment.time.integrator->inertia() || static_cast<size_t>(body) >= experiment.objects.size() || b.tets.empty()) return std::nullopt;
  const double young = softest_young(experiment.objects[static_cast<size_t>(body)]);
  const double mass = body_mass(world, body);
  double volume = 0;
  for (const Tet& t : b.tets) volume += tet_volume(vertex(world.rest, t[0]), vertex(world.rest, t[1]), vertex(world.rest, t[2]), vertex(world.rest, t[3]));
  if (!(young > 0 && mass > 0 && volume > 0)) return std::nullopt;
  return extent_of(b, world.start.x).sizes().maxCoeff() * std::sqrt(mass / volume / young);
}

}  // namespace tack
