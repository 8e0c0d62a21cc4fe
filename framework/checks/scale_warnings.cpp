#include "framework/checks/scale_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/body/extent.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

// Contact distance over the middle side of a body's box, below which a warning is printed. It is
// below the geometric mean of the usual ratio (1e-3) and a thousandth of that.
constexpr double least_distance_part = 3e-5;
// Millimetres that were read as metres: a thousandth of what is smaller would be less than a millimetre [m]. Contact distances of nanometres belong to such bodies.
constexpr double smallest_doubted = 1;

double mass_of(const World& world, int body) {
  double mass = 0;
  for (const int v : world.vertices_of(body)) mass += world.mass(v);
  return mass;
}

// The second of the three: rods and sheets may be long.
double middle_side(const Eigen::AlignedBox3d& box) {
  std::array<double, 3> sides{box.sizes().x(), box.sizes().y(), box.sizes().z()};
  std::sort(sides.begin(), sides.end());
  return sides[1];
}

std::string remedy(const Body& body) {
  return body.from_file ? "is its file in millimetres? Scale it (place.scale: [0.001, 0.001, 0.001])" : "lengths without a unit are metres";
}

}  // namespace

std::string size_text(const World& world, int body) {
  const Body& b = world.bodies[static_cast<size_t>(body)];
  const Eigen::AlignedBox3d box = extent_of(b, world.start.x);
  double speed = 0;
  for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v) speed = std::max(speed, vertex(world.start.v, v).norm());
  std::string text = fmt::format("{:.4g} x {:.4g} x {:.4g} m", box.sizes().x(), box.sizes().y(), box.sizes().z());
  if (const double mass = mass_of(world, body); mass > 0) text += fmt::format(", {:.4g} kg", mass);
  if (speed > 0) text += fmt::format(", {:.4g} m/s", speed);
  return text;
}

std::vector<std::string> scale_warnings(const SceneConfig& scene, const World& world) {
  CopiedLines lines;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    if (!body.movable || i >= scene.objects.size()) continue;
    const ObjectConfig& object = scene.objects[i];
    const Eigen::AlignedBox3d box = extent_of(body, world.start.x);
    const double side = middle_side(box), gravity = world.gravity.norm();
    if (scene.contact && side >= smallest_doubted && scene.contact->contact_distance < least_distance_part * side) {
      lines.tell(object, "large", fmt::format("object '{}' is {:.4g} m large, {:.2g} times the contact distance ({:.4g} m): {}, or take a larger contact.distance", body.name,
                                              side, side / scene.contact->contact_distance, scene.contact->contact_distance, remedy(body)));
      continue;
    }
    if (body.tets.empty() || gravity == 0) continue;
    const double young = softest_young(object), height = std::abs(box.sizes().dot(world.gravity.cwiseAbs()) / gravity);
    const double pressure = mass_of(world, static_cast<int>(i)) * gravity * height / box.volume();
    if (young > 0 && pressure > young)
      lines.tell(object, "heavy", fmt::format("object '{}' is {:.4g} m high, and its weight presses on its base with {:.3g} Pa, more than Young's modulus ({:.3g} Pa): it "
                                              "cannot stand; {}", body.name, height, pressure, young, remedy(body)));
  }
  return lines.texts();
}

}  // namespace tack
