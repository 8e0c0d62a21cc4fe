#include "framework/checks/scale_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "framework/body/extent.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/world/body_mass.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

// Contact distance over the middle side of a body's box, below which a warning is printed: the study
// in the header.
constexpr double least_distance_part = 3e-5;
// Smallest middle side with a warning [m]: a thousandth of a smaller body would be less than a
// millimetre, a size to which contact distances of nanometres belong.
constexpr double smallest_doubted = 1;
// Extent over that of the largest other body, above which a warning is printed: the second study in the header.
constexpr double largest_ratio = 30;

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
  return body.from_file ? "is its file in millimetres? Say so (shape: {type: file, unit: mm}), or scale it (place.scale: [0.001, 0.001, 0.001])" : "lengths without a unit are metres";
}

// Formats lengths with the unit that suits the largest one: "60 x 20 x 20 mm".
std::string lengths_text(const std::vector<double>& lengths) {
  const double largest = *std::max_element(lengths.begin(), lengths.end());
  const char* unit = "m";
  double factor = 1;
  for (const auto& [smaller, name] : {std::pair{1e-3, "mm"}, {1e-6, "um"}, {1e-9, "nm"}}) {
    if (largest >= factor || largest == 0) break;
    factor = smaller;
    unit = name;
  }
  std::string text;
  for (const double length : lengths) text += fmt::format("{}{:.4g}", text.empty() ? "" : " x ", length / factor);
  return text + " " + unit;
}

// Warns of a body that is far larger than all others, and returns its number, or -1. Fixed bodies that are no files, such as floors, may be.
int add_unequal_size(const SceneConfig& scene, const World& world, CopiedLines& lines) {
  std::vector<double> extents;
  for (const Body& body : world.bodies) extents.push_back(extent_of(body, world.start.x).sizes().maxCoeff());
  for (size_t i = 0; i < std::min(world.bodies.size(), scene.objects.size()); ++i) {
    const Body& body = world.bodies[i];
    if (extents[i] < smallest_doubted || !(body.movable || body.from_file)) continue;
    const double ratio = size_ratio(extents, i);
    if (!(ratio > largest_ratio)) continue;
    lines.add(scene.objects[i], WarningKind::large_object, fmt::format("object '{}' is {} large, and the largest other one {}: {}", body.name, lengths_text({extents[i]}),
                                                                       lengths_text({extents[i] / ratio}), remedy(body)));
    return static_cast<int>(i);  // at most one is so much larger than all others
  }
  return -1;
}

}  // namespace

std::string size_text(const World& world, int body) {
  const Body& b = world.bodies[static_cast<size_t>(body)];
  const Eigen::AlignedBox3d box = extent_of(b, world.start.x);
  double speed = 0;
  for (int v = b.first_vertex; v < b.first_vertex + b.vertex_count; ++v) speed = std::max(speed, vertex(world.start.v, v).norm());
  std::string text = lengths_text({box.sizes().x(), box.sizes().y(), box.sizes().z()});
  if (const double mass = body_mass(world, body); mass > 0) text += fmt::format(", {:.4g} kg", mass);
  if (speed > 0) text += fmt::format(", {:.4g} m/s", speed);
  return text;
}

double size_ratio(const std::vector<double>& extents, size_t body) {
  double others = 0;
  for (size_t i = 0; i < extents.size(); ++i)
    if (i != body) others = std::max(others, extents[i]);
  return others > 0 ? extents[body] / others : 0;
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
    if (!body.tets.empty() && young > 0) scale.sag = body_mass(world, scale.body) * world.gravity.norm() * height(box, world) / (box.volume() * young);
    scales.push_back(scale);
  }
  return scales;
}

std::vector<Warning> scale_warnings(const SceneConfig& scene, const World& world) {
  CopiedLines lines;
  const int unequal = add_unequal_size(scene, world, lines);
  for (const BodyScale& scale : body_scales(scene, world)) {
    const Body& body = world.bodies[scale.body];
    const ObjectConfig& object = scene.objects[scale.body];
    if (scale.body == unequal) continue;
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
