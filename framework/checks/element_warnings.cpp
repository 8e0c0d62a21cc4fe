#include "framework/checks/element_warnings.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <unordered_map>

#include "framework/scene/copied_lines.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

constexpr double largest_poisson = 0.45;
constexpr int least_edges = 32;  // of a full turn
constexpr double corner = 75 * std::numbers::pi / 180;  // between edges: not a part of a curve

// Returns the largest Poisson's ratio of a body of linear tets; 0 for other bodies.
double poisson_of(const ObjectConfig& object, const Body& body) {
  double largest = 0;
  if (body.tets.empty() || body.elements != Elements::linear || !body.frame.empty() || !body.movable) return largest;
  for (const auto& energy : object.energies)
    if (const auto poisson = energy->poisson()) largest = std::max(largest, *poisson);
  return largest;
}

bool twists(const ObjectConfig& object) {
  return std::any_of(object.energies.begin(), object.energies.end(), [](const auto& energy) { return energy->twists(); });
}

// Returns the angle by which most edges of a rod turn against the next [rad], if the rod is a
// curve; 0 if most go straight on.
double turn_of(const Body& body, const VecX& rest) {
  std::unordered_map<int, std::array<int, 2>> ends;  // of the edges at a vertex: their other ends
  std::unordered_map<int, int> edges;
  for (const auto& [a, b] : body.edges)
    for (const auto& [from, to] : {std::pair(a, b), std::pair(b, a)})
      if (const int n = edges[from]++; n < 2) ends[from][n] = to;
  std::vector<double> turns;
  for (const auto& [v, n] : edges) {
    if (n != 2) continue;
    const Vec3 in = vertex(rest, v) - vertex(rest, ends[v][0]), out = vertex(rest, ends[v][1]) - vertex(rest, v);
    turns.push_back(std::atan2(in.cross(out).norm(), in.dot(out)));
  }
  if (turns.empty()) return 0;
  const auto middle = turns.begin() + static_cast<std::ptrdiff_t>(turns.size() / 2);
  std::nth_element(turns.begin(), middle, turns.end());
  return *middle < corner ? *middle : 0;
}

}  // namespace

std::vector<Warning> element_warnings(const SceneConfig& scene, const World& world) {
  CopiedLines lines;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const ObjectConfig& object = scene.objects[i];
    if (const double poisson = poisson_of(object, body); poisson > largest_poisson * (1 + 1e-9))
      lines.add(object, WarningKind::volume_locking,
                 fmt::format("the linear tets of '{}' lock in volume with a Poisson's ratio of {:.4g}: it is too stiff wherever its strain is not "
                             "the same all over, when bent with 8 cells across by a factor of 1.7 at 0.49 and 6 at 0.499; take `elements: "
                             "composite` (or patches, which bend as they do at 0.3), or {:g} or less",
                             body.name, poisson, largest_poisson));
    if (!body.movable || body.edges.empty() || !twists(object)) continue;
    if (const double turn = turn_of(body, world.rest); turn > (1 + 1e-6) * 2 * std::numbers::pi / least_edges)
      lines.add(object, WarningKind::coarse_rod,
                 fmt::format("the edges of '{}' turn by {:.3g} degrees from one to the next, {:.3g} for a full turn: a curve of so few is about {:.2g}% "
                             "off in its stiffness; take {} or more for a full turn",
                             body.name, turn * 180 / std::numbers::pi, 2 * std::numbers::pi / turn, 65 * turn * turn, least_edges));
  }
  return lines.warnings();
}

}  // namespace tack
