#include "framework/setup/sheet_stiffness.hpp"

#include <cmath>

#include "framework/setup/dynamic_pressure.hpp"

namespace tack {
namespace {

// The barrier is a tenth of the modulus: a gap of 0.94 ranges under the expected pressure.
constexpr double of_pressing = 1000;
constexpr double of_tension = 10;
constexpr double strain = 1e-3, radius = 0.1;      // of the tension; radius in sizes of the sheet

// Returns false for sheets stretched by motions, attachments, loads or interactions, which press
// with the strength of their material.
bool is_unconstrained(const ObjectConfig& object, const SceneConfig& scene) {
  return object.motion.empty() && object.attach.empty() && object.loads.empty() && scene.interactions.empty();
}

double sheet_stiffness(const ObjectConfig& object, const Body& body, const Loading& loading, const World& world, double step) {
  if (!body.movable || body.sheet.empty() || !body.tets.empty() || !body.frame.empty()) return 0;
  const auto rest = [&](int v) { return Vec3(vertex(world.rest, v)); };
  double area = 0, mass = 0;
  for (const Triangle& t : body.sheet) area += (rest(t[1]) - rest(t[0])).cross(rest(t[2]) - rest(t[0])).norm() / 2;
  for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) mass += world.mass(v);
  const double pressing = (loading.weight + mass * loading.speed / step) / area;
  const double tension = softest_young(object) * body.thickness * strain / (radius * std::sqrt(area));
  const double stiffness = of_pressing * pressing + of_tension * tension;
  return to_two_digits(stiffness);
}

}  // namespace

std::vector<double> sheet_stiffnesses(const SceneConfig& scene, const World& world, const std::vector<Loading>& loadings, double step) {
  std::vector<double> stiffnesses;
  for (size_t i = 0; i < world.bodies.size(); ++i)
    stiffnesses.push_back(is_unconstrained(scene.objects[i], scene) ? sheet_stiffness(scene.objects[i], world.bodies[i], loadings[i], world, step) : 0);
  return stiffnesses;
}

}  // namespace tack
