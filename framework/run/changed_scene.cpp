#include "framework/run/changed_scene.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double position_tolerance = 1e-12;  // of a position, and in metres: rounding

void require_equal_meshes(const World& before, const World& after) {
  const auto differs = [](const Body& a, const Body& b) {
    return a.name != b.name || a.vertex_count != b.vertex_count || a.tets != b.tets || a.triangles != b.triangles || a.edges != b.edges || a.points != b.points;
  };
  if (before.bodies.size() != after.bodies.size() || before.rest.size() != after.rest.size())
    throw InputError(fmt::format("a simulation goes on with the vertices that it has, and the changed scene has {} objects and {} vertices in place of {} and {}", after.bodies.size(),
                                 after.rest.size() / 3, before.bodies.size(), before.rest.size() / 3));
  for (size_t i = 0; i < before.bodies.size(); ++i)
    if (differs(before.bodies[i], after.bodies[i]))
      throw InputError(fmt::format("a simulation goes on with the vertices that it has, and the change gives object '{}' another mesh", after.bodies[i].name));
  if (before.prescribed_motion.assignments().size() != after.prescribed_motion.assignments().size())
    throw InputError("motions cannot be added or taken away between steps; give the motion from the start, and change its numbers");
}

// Moves the reference of each active motion so that it goes on from where its vertices are.
void continue_motions(const World& world, State& state) {
  if (state.x_motion_start.size() == 0) return;
  const PrescribedMotion& motions = world.prescribed_motion;
  const size_t count = motions.assignments().size();
  for (size_t i = 0; i < count; ++i) {
    if (i >= state.motion_active.size() || !state.motion_active[i]) continue;
    const PrescribedMotion::Assignment& assignment = motions.assignments()[i];
    std::vector<char> alone(count, 0);
    alone[i] = 1;
    const auto error = [&](VecX& displaced) {
      VecX x = state.x;
      motions.set_positions(alone, world.rest, state.x_motion_start, state.time, x);
      displaced = state.x - x;
      double largest = 0;
      for (const int v : assignment.vertices) largest = std::max(largest, vertex(displaced, v).norm() / (1 + vertex(state.x, v).norm()));
      return largest;
    };
    VecX displaced;
    if (error(displaced) <= position_tolerance) continue;
    for (const int v : assignment.vertices) vertex(state.x_motion_start, v) += vertex(displaced, v);
    if (error(displaced) > position_tolerance)
      throw InputError(fmt::format("{}: the changed motion does not go on from where its vertices are; change a translation, or let a protocol drive it (type: driven)", assignment.name));
  }
}

}  // namespace

State changed_state(const Simulation& before, Simulation& after) {
  require_equal_meshes(before.world(), after.world());
  State state = before.state();
  if (before.experiment().time.step != after.experiment().time.step) state.step_size = {};
  if (static_cast<bool>(before.protocols()) != static_cast<bool>(after.protocols())) throw InputError("protocols cannot be added or taken away between steps");
  after.renew_protocols(state);
  continue_motions(after.world(), state);
  state.energy = {};
  return state;
}

}  // namespace tack
