#include "framework/stepping/fixed_vertices.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <optional>

#include "geometry/errors.hpp"

namespace tack {
namespace {

Vec3 centre(const VecX& x, const std::vector<int>& vertices) {
  Vec3 sum = Vec3::Zero();
  for (const int v : vertices) sum += vertex(x, v);
  return sum / static_cast<double>(vertices.size());
}

// Returns whether the vertices, which keep their distances, rotate by more than a quarter turn from a
// to b. The mean of the positions before and after a rotation by w is narrower across the axis by
// the factor cos(w/2).
bool more_than_a_quarter(const std::vector<int>& vertices, const VecX& a, const VecX& b) {
  constexpr double width_ratio_min = 0.7;
  const Vec3 centre_a = centre(a, vertices), centre_b = centre(b, vertices);
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) {
    const Vec3 from_a = vertex(a, v) - centre_a, from_b = vertex(b, v) - centre_b;
    return (from_a + from_b).norm() / 2 < width_ratio_min * from_a.norm();
  });
}

// Throws SimulationError if the prescribed position of a vertex of an affine body is not that by the
// frame of the body, which depends on other fixed vertices.
void check_affine(const PrescribedMotion::Assignment& assignment, int v, const VecX& prescribed, const VecX& x) {
  constexpr double tolerance = 1e-6;  // of the distance from the first vertex of the motion
  const double error = (vertex(prescribed, v) - vertex(x, v)).norm();
  const double size = (vertex(prescribed, v) - vertex(prescribed, assignment.vertices.front())).norm();
  if (error <= tolerance * size + 1e-12 * vertex(prescribed, v).norm()) return;
  throw SimulationError(fmt::format("{}: would deform an affine body (vertex {} by {:.3g} m) other than "
                                    "affinely; move its vertices rigidly, or fix fewer of them", assignment.name, v, error));
}

// Throws SimulationError if vertices fixed on both sides of a joint violate it.
void check_joints(const std::vector<Joint>& joints, const VecX& x) {
  constexpr double tolerance = 1e-6;  // of the distance of attachment points from each other, or from the origin
  for (const Joint& joint : joints) {
    const double error = joint_error(joint, x);
    double size = 0;
    for (const int v : joint.attachment_points) size = std::max(size, (vertex(x, v) - vertex(x, joint.attachment_points.front())).norm());
    const double far = vertex(x, joint.attachment_points.front()).norm();
    if (error > tolerance * std::max(size, far) + 1e-12)
      throw SimulationError(fmt::format("joint '{}' would be torn by {:.3g} m: the vertices fixed on its two sides move against each other; fix one side, "
                                        "or take the joint away", joint.name, error));
  }
}

}  // namespace

bool FixedVertices::activate(const State& state, double middle) {
  std::vector<char> active = prescribed_motion_.active(middle);
  const std::vector<char> timed = constraints_.active(middle);
  active.insert(active.end(), timed.begin(), timed.end());
  if (known_ && active == active_) return false;
  std::optional<DofMap> before;  // none before the first step
  if (known_) before = std::move(dofs_);
  else if (state.step > 0) before = dofs_of(state.motion_active);
  known_ = true;
  active_ = std::move(active);
  dofs_ = dofs_of(active_);
  fixed_.clear();
  released_.clear();
  for (int v = 0; v < dofs_.vertex_count(); ++v) {
    if (!dofs_.moves(v)) fixed_.push_back(v);
    if (dofs_.owns(v) && !(before && before->moves(v))) released_.push_back(v);
  }
  x_motion_start_ = state.x_motion_start.size() > 0 ? state.x_motion_start : state.x;
  for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i)
    if (active_[i] && !(i < state.motion_active.size() && state.motion_active[i]))
      for (const int v : prescribed_motion_.assignments()[i].vertices) vertex(x_motion_start_, v) = vertex(state.x, v);
  return true;
}

DofMap FixedVertices::dofs_of(const std::vector<char>& active) const {
  const std::vector<char> free = prescribed_motion_.free(active);
  const auto timed = active.begin() + static_cast<std::ptrdiff_t>(prescribed_motion_.assignments().size());
  return DofMap(free, constraints_.at(free, {timed, active.end()}), prescribed_motion_.fixed_directions(active));
}

std::vector<char> FixedVertices::moving() const {
  std::vector<char> moving(dofs_.vertex_count());
  for (int v = 0; v < dofs_.vertex_count(); ++v) moving[v] = dofs_.moves(v);
  return moving;
}

void FixedVertices::set_positions(double t, VecX& x) const {
  prescribed_motion_.set_positions(active_, rest_, x_motion_start_, t, x);
  if (dofs_.dependents().empty()) return;
  const VecX prescribed = x;
  dofs_.update_dependents(x);
  for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i) {
    if (!active_[i] || prescribed_motion_.assignments()[i].motion->partial()) continue;
    for (const int v : prescribed_motion_.assignments()[i].vertices) check_affine(prescribed_motion_.assignments()[i], v, prescribed, x);
  }
  check_joints(constraints_.joints(), x);
}

void FixedVertices::commit(State& state) {
  if (active_ == state.motion_active && state.x_motion_start.size() > 0) return;
  state.motion_active = active_;
  state.x_motion_start = x_motion_start_;
}

int FixedVertices::rotation_substeps(double t, double h) const {
  constexpr int max_substeps = 64;
  const auto rotates_too_far = [&](double from, double until) {
    VecX start = rest_, end = rest_;
    set_positions(from, start);
    set_positions(until, end);
    for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i) {
      const PrescribedMotion::Assignment& assignment = prescribed_motion_.assignments()[i];
      const bool rotating = active_[i] && assignment.motion->moves() && assignment.motion->rigid();
      if (rotating && more_than_a_quarter(assignment.vertices, start, end)) return true;
    }
    return false;
  };
  int substeps = 1;
  for (int i = 0; i < substeps && substeps < max_substeps; ++i)
    if (rotates_too_far(t + h * i / substeps, t + h * (i + 1) / substeps)) substeps *= 2, i = -1;
  return substeps;
}

bool FixedVertices::may_move() const {
  const auto& partly = dofs_.partly_fixed_blocks();
  return std::any_of(fixed_.begin(), fixed_.end(), [&](int v) { return prescribed_motion_.may_move(v); }) ||
         std::any_of(partly.begin(), partly.end(), [&](const auto& h) { return prescribed_motion_.moves(dofs_.vertex_of_block(h.block)); });
}

}  // namespace tack
