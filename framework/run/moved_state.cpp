#include "framework/run/moved_state.hpp"

#include <fmt/format.h>

#include <Eigen/Dense>

#include "framework/body/extent.hpp"
#include "framework/world/consistent_mass.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Sets the frames of affine bodies such that their mesh vertices are nearest to their positions in
// the field (3n).
void fit_frames(const World& world, VecX& field) {
  const int meshes = world.mesh_vertex_count();
  for (const AffineFrame& frame : world.constraints.frames()) {
    Eigen::Matrix4d normal = Eigen::Matrix4d::Zero();
    Eigen::Matrix<double, 4, 3> sums = Eigen::Matrix<double, 4, 3>::Zero();
    for (const AffineFrame::Dependent& dependent : frame.dependents) {
      if (dependent.vertex >= meshes) continue;
      const Eigen::Map<const Eigen::Vector4d> w(dependent.weights.data());
      normal += w * w.transpose();
      sums += w * vertex(field, dependent.vertex).transpose();
    }
    const Eigen::Matrix<double, 4, 3> fitted = normal.ldlt().solve(sums);
    for (int i = 0; i < 4; ++i) vertex(field, frame.frame[i]) = fitted.row(i).transpose();
  }
}

void check_followed(const World& world, const VecX& asked, const VecX& x) {
  constexpr double tolerated = 1e-6;  // fraction of the object's size
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    const Body& body = world.bodies[i];
    const double size = extent_of(body, world.rest).diagonal().norm();
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v) {
      const double off = (vertex(asked, v) - vertex(x, v)).norm();
      if (off <= tolerated * size) continue;
      throw InputError(fmt::format("vertex {} of '{}' follows others and would be {:.3g} m from where it is put; move affine bodies affinely, and what is "
                                   "attached or joined together with what it is attached or joined to", v - body.first_vertex, body.name, off));
    }
  }
}

// Returns the account without the state's energies. Dissipation and work so far stay.
EnergyAccount reopened(EnergyAccount account) {
  account.open = false;
  account.kinetic = account.gravity = account.elastic = account.contact = 0;
  account.gradient.resize(0);
  account.growing_steps = 0;
  return account;
}

}  // namespace

State moved_state(const World& world, const State& before, const VecX& x, const VecX& v) {
  State state;
  state.time = before.time;
  state.step = before.step;
  state.x = before.x;
  state.v = before.v;
  state.x.head(x.size()) = x;
  state.v.head(v.size()) = v;
  fit_frames(world, state.x);
  fit_frames(world, state.v);
  if (!world.constraints.joints().empty()) project_velocities(world.dofs, world.mass, state.v);
  const VecX asked = state.x;
  world.dofs.update_dependents(state.x);
  world.dofs.update_dependents(state.v);
  check_followed(world, asked, state.x);
  state.x_motion_start = before.x_motion_start;
  state.motion_active = before.motion_active;
  state.history = before.history;
  state.energy = reopened(before.energy);
  return state;
}

}  // namespace tack
