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

// Contact distance over the middle side of a body's box, below which a warning is printed: the study
// in the header.
constexpr double least_distance_part = 3e-5;
// Smallest middle side with a warning [m]: a thousandth of a smaller body would be less than a
// millimetre, a size to which contact distances of nanometres belong.
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

// Along gravity [m]; 0 without gravity.
double height(const Eigen::AlignedBox3d& box, const World& world) {
  const double gravity = world.gravity.norm();
  return gravity > 0 ? std::abs(box.sizes().dot(world.gravity.cwiseAbs()) / gravity) : 0;
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

std::vector<BodyScale> body_scales(const SceneConfig& scene, const World& world) {
  std::vector<BodyScale> scales;
  for (size_t i = 0; i < std::min(world.bodies.size(), scene.objects.size()); ++i) {
    const Body& body = world.bodies[i];
    if (!body.movable) continue;
    const Eigen::AlignedBox3d box = extent_of(body, world.start.x);
    BodyScale scale{static_cast<int>(i), middle_side(box)};
    if (scene.contact) scale.distance = scene.contact->contact_distance / scale.side;
    const double young = softest_young(scene.objects[i]);
    if (!body.tets.empty() && young > 0) scale.sag = mass_of(world, scale.body) * world.gravity.norm() * height(box, world) / (box.volume() * young);
    scales.push_back(scale);
  }
  return scales;
}

std::vector<Warning> scale_warnings(const SceneConfig& scene, const World& world) {
  CopiedLines lines;
  for (const BodyScale& scale : body_scales(scene, world)) {
    const Body& body = world.bodies[scale.body];
    const ObjectConfig& object = scene.objects[scale.body];
    if (scene.contact && scale.side >= smallest_doubted && scale.distance < least_distance_part) {
      lines.add(object, WarningKind::large_object, fmt::format("object '{}' is {:.4g} m large, {:.2g} times the contact distance ({:.4g} m): {}, or take a larger contact.distance", body.name,
                                              scale.side, 1 / scale.distance, scene.contact->contact_distance, remedy(body)));
    } else if (scale.sag > 1) {
      const double young = softest_young(object);
      lines.add(object, WarningKind::heavy_object, fmt::format("object '{}' is {:.4g} m high, and its weight presses on its base with {:.3g} Pa, more than Young's modulus ({:.3g} Pa): it "
                                              "cannot stand; {}", body.name, height(extent_of(body, world.start.x), world), scale.sag * young, young, remedy(body)));
    }
  }
  return lines.warnings();
}

}  // namespace tack
