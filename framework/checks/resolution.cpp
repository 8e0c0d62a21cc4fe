#include "framework/checks/resolution.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/surface/surface_topology.hpp"
#include "framework/core/term_gradient.hpp"
#include "framework/scene/copied_lines.hpp"
#include "framework/scene/scene_config.hpp"
#include "framework/setup/adhesion_lengths.hpp"
#include "framework/setup/dynamic_pressure.hpp"
#include "framework/world/world.hpp"
#include "geometry/mesh/quality.hpp"
#include "geometry/mesh/thickness.hpp"

namespace tack {
namespace {

// Means over the surface of one object.
struct SurfaceMeasure {
  double size = 0;       // of an element, the root of twice its area, or the length of a rod's edge; 0 for particles [m]
  double gap_change = 0; // h theta / 2 over the smooth edges [m]
  double thickness = 0;  // 2 V / A [m]; 0 for sheets
};

std::vector<SurfaceMeasure> measure(const ContactSurface& surface, size_t objects) {
  const CollisionMesh& mesh = surface.mesh;
  const VecX& x = surface.rest;
  std::vector<SurfaceMeasure> all(objects);
  std::vector<int> triangles(objects, 0), smooth(objects, 0);
  for_each_edge(surface, [&](std::span<const EdgeUse> uses, const std::optional<double>& angle) {
    if (!angle) return;
    const auto [a, b] = uses[0].edge;
    all[mesh.vertex_object[a]].gap_change += (vertex(x, a) - vertex(x, b)).norm() * *angle / 2;
    ++smooth[mesh.vertex_object[a]];
  });
  std::vector<Thickness> thickness(objects);
  std::vector<char> sheet(objects, 0);
  std::vector<double> length(objects, 0);
  std::vector<int> edges(objects, 0);
  for (const int e : mesh.codim_edges) {
    const auto& [a, b] = mesh.edges[e];
    length[mesh.vertex_object[a]] += (vertex(x, a) - vertex(x, b)).norm();
    ++edges[mesh.vertex_object[a]];
  }
  for (size_t i = 0; i < mesh.triangles.size(); ++i) {
    const Triangle& t = mesh.triangles[i];
    const int object = mesh.vertex_object[t[0]];
    thickness[object].add(corners(x, t));
    ++triangles[object];
    if (surface.two_sided[i]) sheet[object] = 1;
  }
  for (size_t i = 0; i < objects; ++i) {
    all[i].size = triangles[i] > 0 ? std::sqrt(2 * thickness[i].area() / triangles[i]) : edges[i] > 0 ? length[i] / edges[i] : 0;
    all[i].gap_change /= std::max(smooth[i], 1);
    if (!sheet[i]) all[i].thickness = thickness[i].thickness();
  }
  return all;
}

// Returns the element size of the mesh, whatever surface contact sees [m].
double element_size(const Body& body, const VecX& rest) {
  double area = 0;
  for (const Triangle& t : body.triangles) {
    const auto [a, b, c] = corners(rest, t);
    area += triangle_area(a, b, c);
  }
  return std::sqrt(2 * area / static_cast<double>(std::max<size_t>(body.triangles.size(), 1)));
}

// Two objects that press on each other at the start are squeezed if this fraction of their forces
// is balanced by others of the pair, and the forces exceed the weight of the lighter one. They are
// thrown apart if the energy of the barrier lifts the lighter one by that many contact distances;
// an object put down to rest has less than one.
constexpr double squeezed_fraction = 0.5, thrown_distances = 10;
constexpr double standard_gravity = 9.81;  // m/s^2, of these weights

// Contact between two objects that press on each other at the start.
struct PressedPair {
  Vec3 resultant = Vec3::Zero();  // N
  double sum = 0;                 // of magnitudes [N]
  double energy = 0;              // of the barrier [J]
  double gap = std::numeric_limits<double>::infinity();  // the smallest [m]
};

// Pairs with the same kind of warning, which reports the worst of them.
struct WorstPair {
  double measure = 0;
  int lighter = -1, count = 0;
  std::string line;

  void add(double of_pair, int lighter_object, const std::function<std::string()>& text) {
    ++count;
    if (of_pair > measure) measure = of_pair, lighter = lighter_object, line = text();
  }
};

class Warnings {
 public:
  Warnings(const SceneConfig& scene, World& world)
      : scene_(scene), world_(world), measures_(measure(world.contact->surface(), world.bodies.size())) {}

  std::vector<Warning> take() {
    const ObjectClasses& classes = world_.contact->pairs().classes();
    for (const AdhesionSummary& adhesion : world_.adhesion)
      for (const auto& [a, b] : adhesion.kinds) {
        interface(adhesion, a, b);
        if (a == b) continue;
        // The others of their classes, which may have other meshes.
        for (int i = 0; i < classes.objects(); ++i) {
          if (i != a && i != b && classes.of(i) == classes.of(a)) interface(adhesion, i, b);
          if (i != a && i != b && classes.of(i) == classes.of(b)) interface(adhesion, a, i);
        }
      }
    for (size_t i = 0; i < world_.bodies.size(); ++i) body(static_cast<int>(i));
    start();
    return lines_.warnings();
  }

 private:
  void interface(const AdhesionSummary& adhesion, int a, int b) {
    const double zone = process_zone(pair_stiffness(scene_, world_, {a, b}).young, adhesion.work_of_adhesion, adhesion.peak_traction);
    const double range = world_.contact->pairs().point(a, b, adhesion.region_pair).range - world_.contact->pairs().offset(a, b);
    for (const int i : a == b ? std::vector{a} : std::vector{a, b}) {
      const SurfaceMeasure& m = measures_[i];
      const std::string& name = world_.bodies[i].name;
      const double size = world_.bodies[i].surface_triangles.empty() ? m.size : element_size(world_.bodies[i], world_.rest);
      const double bending = bending_stiffness(scene_.objects[i], world_.bodies[i]);
      if (bending == 0 && softest_young(scene_.objects[i]) > 0 && size > (1 + 1e-6) * zone && first_time(i, WarningKind::process_zone))
        warn(i, WarningKind::process_zone, fmt::format(
            "elements of '{}' ({:.3g} m) are larger than the process zone of its adhesion '{}' - '{}' (E W / "
            "sigma^2 = {:.3g} m): where it peels or tears, it lets go too late; refine '{}'",
            name, size, world_.bodies[a].name, world_.bodies[b].name, zone, name));
      const double length = bending_length(bending, adhesion.work_of_adhesion, adhesion.peak_traction);
      if (length > 0 && size > (1 + 1e-6) * mesh_size_max_per_bending_length * length && first_time(i, WarningKind::bending_length))
        warn(i, WarningKind::bending_length, fmt::format(
            "elements of '{}' ({:.3g} m) are larger than a half of the length over which it bends where its adhesion '{}' - '{}' "
            "lets go ((2 B W / sigma^2)^(1/4) = {:.3g} m, B its bending stiffness per width): the force of peeling is not "
            "resolved; refine '{}'",
            name, size, world_.bodies[a].name, world_.bodies[b].name, length, name));
      if (m.gap_change > gap_change_per_range * range && first_time(i, WarningKind::coarse_curvature))
        warn(i, WarningKind::coarse_curvature, fmt::format(
            "the surface of '{}' is coarse for its adhesion '{}' - '{}': across one element ({:.3g} m) the gap "
            "changes by about {:.2g} m of a range of {:.3g} m; refine '{}'",
            name, world_.bodies[a].name, world_.bodies[b].name, m.size, m.gap_change, range, name));
    }
  }

  void body(int i) {
    const double range = world_.contact->pairs().point(i, i).range_max() - world_.contact->pairs().offset(i, i), distance = scene_.contact->contact_distance;
    const SurfaceMeasure& m = measures_[i];
    const std::string& name = world_.bodies[i].name;
    if (!world_.bodies[i].movable) return;
    if (m.size > 0 && distance > m.size)
      warn(i, WarningKind::contact_distance, fmt::format("contact.distance ({:.3g} m) exceeds the elements of '{}' ({:.3g} m); lower it "
                                   "to a half of them or less",
                                   distance, name, m.size));
    if (m.thickness > 0 && range > m.thickness)
      warn(i, WarningKind::self_contact_range, fmt::format("the contact of '{}' with itself has a range ({:.3g} m) above its thickness "
                                   "({:.3g} m); lower the range, or name the pair with contact: false",
                                   name, range, m.thickness));
  }

  // Forces of bodies on themselves.
  void start() {
    world_.contact->begin_step({world_.start.x});
    world_.contact->move_to(world_.start.x);
    std::set<int> on_themselves;
    world_.contact->potential().visit_active([&](const ActivePair& pair) {
      if (pair.object == pair.opposite) on_themselves.insert(pair.object);
    });
    for (const int i : on_themselves) {
      const VecX force = forces_within(i);
      Eigen::Index at = 0;
      const double largest = force.size() > 0 ? force.cwiseAbs().maxCoeff(&at) : 0;
      if (!(largest > 0)) continue;
      warn(i, WarningKind::self_contact_force, fmt::format(
          "'{}' starts with contact forces on itself (up to {:.3g} N, at its vertex {}): it will deform by itself; "
          "lower contact.distance or the range of its adhesion below the gaps between its parts",
          world_.bodies[i].name, largest, world_.index_in_body(static_cast<int>(at / 3))));
    }
    between_objects();
  }

  // Returns the forces of an object on itself at the start (3n) [N].
  VecX forces_within(int object) const {
    const std::vector<int>& object_of = world_.contact->surface().mesh.vertex_object;
    VecX gradient = VecX::Zero(world_.start.x.size());
    for (const auto& term : world_.contact->potential().terms())
      add_stencil_gradient(*term, world_.start.x, gradient, [&](std::span<const int> vertices) {
        return std::all_of(vertices.begin(), vertices.end(), [&](int v) { return object_of[v] == object; });
      });
    return -gradient;
  }

  // Forces of bodies on each other that no rest can have.
  void between_objects() {
    const std::vector<PairLaw>& barriers = world_.contact->pairs().laws(LawTerm::barrier);
    const std::vector<char> all(barriers.size(), 1);
    std::map<std::array<int, 2>, PressedPair> pairs;
    for_each_record(contact_points({*world_.contact, all, world_.start.x}), [&](const auto& c) {
      if (c.object == c.opposite || !(c.normal_force > 0)) return;
      PressedPair& pair = pairs[c.objects()];
      pair.resultant += (c.object < c.opposite ? c.normal_force : -c.normal_force) * c.normal;
      pair.sum += c.normal_force;
      pair.energy += c.area * barriers[c.law].at(c.gap).value;
      pair.gap = std::min(pair.gap, c.gap - barriers[c.law].offset());
    });
    WorstPair squeezed, thrown;
    for (const auto& [objects, pair] : pairs) {
      const auto [a, b] = objects;
      const double mass_a = mass_of(a), mass_b = mass_of(b);
      const int lighter = mass_b == 0 || (mass_a > 0 && mass_a <= mass_b) ? a : b;
      const double weight = standard_gravity * (lighter == a ? mass_a : mass_b), distance = scene_.contact->contact_distance;
      if (!(weight > 0)) continue;
      const std::string start = fmt::format("'{}' and '{}' start {:.3g} m apart, within contact.distance ({:.3g} m), and press on each other ",
                                            world_.bodies[a].name, world_.bodies[b].name, pair.gap, distance);
      const std::string& name = world_.bodies[lighter].name;
      if (pair.sum > weight && pair.sum - pair.resultant.norm() > squeezed_fraction * pair.sum)
        squeezed.add(pair.sum / weight, lighter, [&, &pair = pair] {
          return fmt::format("{}from opposite sides with {:.3g} N, {:.3g} times the weight of '{}': it is squeezed, and rubs, before anything moves", start,
                             pair.sum, pair.sum / weight, name);
        });
      else if (pair.energy > thrown_distances * distance * weight)
        thrown.add(pair.energy / weight, lighter, [&, &pair = pair] {
          return fmt::format("{}with {:.3g} N, {:.3g} times the weight of '{}': it is thrown off ({:.3g} m high, by its weight)", start, pair.resultant.norm(),
                             pair.resultant.norm() / weight, name, pair.energy / weight);
        });
    }
    for (const auto& [worst, kind] : {std::pair(&squeezed, WarningKind::squeezed_object), std::pair(&thrown, WarningKind::thrown_object)})
      if (worst->count > 0)
        warn(worst->lighter, kind, fmt::format("{}{}; leave more than contact.distance between them, or lower it", worst->line,
                                               worst->count > 1 ? fmt::format(" (and so {} more pairs)", worst->count - 1) : ""));
  }

  // Returns the mass of the vertices that carry a body [kg]; 0 if it is fixed.
  double mass_of(int i) const {
    const Body& body = world_.bodies[i];
    double mass = 0;
    if (!body.frame.empty())
      for (const int v : body.frame) mass += world_.mass(v);
    else
      for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) mass += world_.mass(v);
    return mass;
  }

  // One warning of a kind is enough for an object, however many others it adheres to, and for all
  // of its copies (fill.hpp).
  bool first_time(int object, WarningKind kind) { return told_.emplace(object, kind).second; }

  void warn(int object, WarningKind kind, std::string line) { lines_.add(scene_.objects[object], kind, std::move(line)); }

  const SceneConfig& scene_;
  World& world_;
  std::set<std::pair<int, WarningKind>> told_;
  std::vector<SurfaceMeasure> measures_;
  CopiedLines lines_;
};

}  // namespace

std::vector<Warning> resolution_warnings(const SceneConfig& scene, World& world) {
  if (!world.contact) return {};
  return Warnings(scene, world).take();
}

}  // namespace tack
