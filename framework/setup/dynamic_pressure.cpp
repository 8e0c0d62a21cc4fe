#include "framework/setup/dynamic_pressure.hpp"

#include <cmath>

#include "framework/setup/reachable_speed.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

double dynamic_pressure(const ObjectConfig& object, const Body& body, const World& world, double speed) {
  if (body.tets.empty() || !body.movable || !body.frame.empty()) return 0;
  double mass = 0, volume = 0;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) mass += world.mass(v);
  const auto rest = [&](int v) { return Vec3(vertex(world.rest, v)); };
  for (const Tet& t : body.tets) volume += tet_volume(rest(t[0]), rest(t[1]), rest(t[2]), rest(t[3]));
  const double pressure = mass / volume * speed * speed;
  if (!(pressure > softest_young(object))) return 0;
  const double digit = std::pow(10, std::floor(std::log10(pressure)) - 1);
  return std::round(pressure / digit) * digit;
}

}  // namespace

double softest_young(const ObjectConfig& object) {
  double least = 0;
  for (const auto& energy : object.energies)
    if (const double young = energy->young().value_or(0); young > 0 && (least == 0 || young < least)) least = young;
  return least;
}

std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world) {
  const double speed = reachable_speed(scene, world);
  std::vector<double> pressures;
  for (size_t i = 0; i < world.bodies.size(); ++i)
    pressures.push_back(dynamic_pressure(scene.objects[i], world.bodies[i], world, speed));
  return pressures;
}

}  // namespace tack
