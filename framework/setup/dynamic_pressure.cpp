#include "framework/setup/dynamic_pressure.hpp"

#include <algorithm>
#include <cmath>

#include "framework/world/body_mass.hpp"
#include "geometry/mesh/quality.hpp"

namespace tack {
namespace {

constexpr int load_samples = 16;  // sampling times of the loads over the duration

double mean_projected_area(const Body& body, const VecX& rest) {
  double area = 0;
  for (const Triangle& t : body.triangles) {
    area += triangle_area(vertex(rest, t[0]), vertex(rest, t[1]), vertex(rest, t[2]));
  }
  const bool closed = !body.tets.empty() || !body.frame.empty();
  return area / (closed ? 4 : 2);
}

double dynamic_pressure(const ObjectConfig& object, const Body& body, const World& world, double speed) {
  if (body.tets.empty() || !body.movable || !body.frame.empty()) return 0;
  double mass = 0, volume = 0;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) mass += world.mass(v);
  const auto rest = [&](int v) { return Vec3(vertex(world.rest, v)); };
  for (const Tet& t : body.tets) volume += tet_volume(rest(t[0]), rest(t[1]), rest(t[2]), rest(t[3]));
  const double pressure = mass / volume * speed * speed;
  return pressure > softest_young(object) ? to_two_digits(pressure) : 0;
}

}  // namespace

double to_two_digits(double value) {
  if (!(value > 0)) return 0;
  const double digit = std::pow(10, std::floor(std::log10(value)) - 1);
  return std::round(value / digit) * digit;
}

double softest_young(const ObjectConfig& object) {
  double least = 0;
  for (const auto& energy : object.energies)
    if (const double young = energy->young().value_or(0); young > 0 && (least == 0 || young < least)) least = young;
  return least;
}

std::vector<double> dynamic_pressures(const SceneConfig& scene, const World& world, const std::vector<Loading>& loadings) {
  std::vector<double> pressures;
  for (size_t i = 0; i < world.bodies.size(); ++i)
    pressures.push_back(dynamic_pressure(scene.objects[i], world.bodies[i], world, loadings[i].speed));
  return pressures;
}

std::vector<double> resting_pressures(const SceneConfig& scene, const World& world, double duration) {
  std::vector<double> forces(world.bodies.size(), 0);
  const auto raise = [&](const VecX& all) {
    for (size_t i = 0; i < forces.size(); ++i) {
      const Body& body = world.bodies[i];
      Vec3 sum = Vec3::Zero();
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) sum += vertex(all, v);
      forces[i] = std::max(forces[i], sum.norm());
    }
  };
  if (!world.load_term.empty())
    for (int k = 0; k <= load_samples; ++k) raise(world.load_term.forces_at(duration * k / load_samples, world.rest.size()));
  std::vector<double> pressures(world.bodies.size(), 0);
  for (size_t i = 0; i < forces.size(); ++i) {
    const Body& body = world.bodies[i];
    if (!body.movable) continue;
    const double mass = body_mass(world, static_cast<int>(i));
    if (const double area = mean_projected_area(body, world.rest); area > 0)
      pressures[i] = to_two_digits((forces[i] + mass * scene.gravity.norm()) / area);
  }
  return pressures;
}

}  // namespace tack
