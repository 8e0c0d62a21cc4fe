#include "framework/setup/spins.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/rod/rod_frames.hpp"
#include "framework/scene/rolling_energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr const char* arcs_name = "spin";

// Returns the arcs of a body's particles, three each; empty if they do not roll.
std::vector<int> arcs_of(int index, const World& world) {
  for (const UnknownGroup& group : world.unknowns)
    if (group.body == index && group.name == world.bodies[index].name + "/" + arcs_name) return group.vertices;
  return {};
}

double gyration_of(const Body& body) { return std::sqrt(0.4) * body.radius; }

// Motion of the arcs of fixed particles: no rotation.
class FixedArcs : public Motion {
 public:
  explicit FixedArcs(const Motion& motion) : Motion(motion.from(), motion.until()) {}
  void set_positions(std::span<const int> vertices, const VecX&, const VecX& reference, double, VecX& x) const override {
    for (const int v : vertices) vertex(x, v) = vertex(reference, v);
  }
  bool moves() const override { return false; }
  bool rigid() const override { return false; }  // an arc is not a position
};

void check_rolling(const ObjectConfig& object, const Body& body) {
  const auto refuse = [&](const std::string& why) { throw InputError(fmt::format("object '{}': {}", object.name, why)); };
  if (!(object.contact_offset > 0))
    refuse("`rolling` needs the lever of friction; give contact_offset, the radius of its rods or particles");
  if (body.rod && !body.section->circular()) refuse("rods with a rectangular section do not roll; take `rolling` away, or give rod.radius");
}

}  // namespace

void add_spins(const ObjectConfig& object, int index, World& world) {
  const Body& body = world.bodies[index];
  if (body.radius == 0 || !rolls(object)) return;
  Unknowns(world, body.name, index).add_scalar_dofs(arcs_name, 3 * static_cast<int>(body.points.size()), gyration_of(body));
}

void add_spin_masses(int index, World& world) {
  const std::vector<int> arcs = arcs_of(index, world);
  for (size_t i = 0; i < arcs.size(); ++i) world.mass(arcs[i]) = world.mass(world.bodies[index].points[i / 3]);
}

void fix_spins(const Motion& motion, const std::vector<int>& vertices, const std::string& name, int index, World& world) {
  if (motion.partial()) return;
  const std::vector<int> arcs = arcs_of(index, world);
  std::vector<int> fixed_arcs;
  for (size_t i = 0; i < arcs.size(); ++i)
    if (std::binary_search(vertices.begin(), vertices.end(), world.bodies[index].points[i / 3])) fixed_arcs.push_back(arcs[i]);
  if (fixed_arcs.empty()) return;
  world.own_motions.push_back(std::make_unique<FixedArcs>(motion));
  world.prescribed_motion.add({world.own_motions.back().get(), std::move(fixed_arcs), name + ", the rotation of its particles"});
}

void set_spin_velocities(const Vec3& angular_velocity, int index, const World& world, VecX& v) {
  const std::vector<int> arcs = arcs_of(index, world);
  for (size_t i = 0; i < arcs.size(); ++i)
    if (world.dofs.moves(arcs[i])) v(3 * arcs[i]) = gyration_of(world.bodies[index]) * angular_velocity(static_cast<int>(i % 3));
}

ContactSpins contact_spins(const SceneConfig& scene, const World& world) {
  ContactSpins spins(static_cast<int>(world.rest.size()) / 3);
  for (int i = 0; i < static_cast<int>(world.bodies.size()); ++i) {
    const Body& body = world.bodies[i];
    const ObjectConfig& object = scene.objects[i];
    if (!rolls(object)) continue;
    check_rolling(object, body);
    if (body.rod)
      for (int e = 0; e < body.rod->count(); ++e) spins.add_rod(body.rod->edge(e), body.rod->twists()[e], object.contact_offset / body.rod->radius());
    const std::vector<int> arcs = arcs_of(i, world);
    for (size_t p = 0; 3 * p < arcs.size(); ++p)
      spins.add_particle(body.points[p], {arcs[3 * p], arcs[3 * p + 1], arcs[3 * p + 2]}, object.contact_offset / gyration_of(body));
  }
  return spins;
}

}  // namespace tack
