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

// Returns whether the vertices, which keep their distances, turn by more than a quarter: half way
// between a and b, a body that turns by an angle w is as wide as cos(w/2) across the axis.
bool more_than_a_quarter(const std::vector<int>& vertices, const VecX& a, const VecX& b) {
  constexpr double narrow = 0.7;
  const Vec3 centre_a = centre(a, vertices), centre_b = centre(b, vertices);
  return std::any_of(vertices.begin(), vertices.end(), [&](int v) {
    const Vec3 from_a = vertex(a, v) - centre_a, from_b = vertex(b, v) - centre_b;
    return (from_a + from_b).norm() / 2 < narrow * from_a.norm();
  });
}

// Vertices that an affine body carries along with other held ones have to be where those say.
void check_followed(const PrescribedMotion::Assignment& assignment, int v, const VecX& placed, const VecX& x) {
  constexpr double tolerance = 1e-6;  // of the way from the first vertex of the hold
  const double off = (vertex(placed, v) - vertex(x, v)).norm();
  const double reach = (vertex(placed, v) - vertex(placed, assignment.vertices.front())).norm();
  if (off <= tolerance * reach + 1e-12 * vertex(placed, v).norm()) return;
  throw SimulationError(fmt::format("{}: would have to deform an affine body (vertex {} by {:.3g} m) otherwise than "
                                    "affinely; move its vertices rigidly, or hold fewer of them", assignment.name, v, off));
}

// Throws SimulationError unless vertices fixed on both sides of a joint move as the joint says.
void check_joints(const std::vector<Joint>& joints, const VecX& x) {
  constexpr double tolerance = 1e-6;  // of how far the object's anchors are apart, or from the origin
  for (const Joint& joint : joints) {
    const double error = joint_error(joint, x);
    double reach = 0;
    for (const int v : joint.attachment_points) reach = std::max(reach, (vertex(x, v) - vertex(x, joint.attachment_points.front())).norm());
    const double far = vertex(x, joint.attachment_points.front()).norm();
    if (error > tolerance * std::max(reach, far) + 1e-12)
      throw SimulationError(fmt::format("joint '{}' would be torn by {:.3g} m: what is held on both sides of it does not move as it says; hold one side, "
                                        "or take the joint away", joint.name, error));
  }
}

}  // namespace

bool FixedVertices::change(const State& state, double middle) {
  std::vector<char> active = prescribed_motion_.active(middle);
  const std::vector<char> ties = constraints_.active(middle);
  active.insert(active.end(), ties.begin(), ties.end());
  if (known_ && active == active_) return false;
  std::optional<DofMap> before;  // before the first step, nothing has a past
  if (known_) before = std::move(dofs_);
  else if (state.step > 0) before = dofs_of(state.motion_active);
  known_ = true;
  active_ = std::move(active);
  dofs_ = dofs_of(active_);
  held_.clear();
  released_.clear();
  for (int v = 0; v < dofs_.vertex_count(); ++v) {
    if (!dofs_.moves(v)) held_.push_back(v);
    if (dofs_.owns(v) && !(before && before->moves(v))) released_.push_back(v);
  }
  anchor_ = state.x_motion_start.size() > 0 ? state.x_motion_start : state.x;
  for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i)
    if (active_[i] && !(i < state.motion_active.size() && state.motion_active[i]))
      for (const int v : prescribed_motion_.assignments()[i].vertices) vertex(anchor_, v) = vertex(state.x, v);
  return true;
}

DofMap FixedVertices::dofs_of(const std::vector<char>& active) const {
  const std::vector<char> free = prescribed_motion_.free(active);
  const auto ties = active.begin() + static_cast<std::ptrdiff_t>(prescribed_motion_.assignments().size());
  return DofMap(free, constraints_.at(free, {ties, active.end()}), prescribed_motion_.fixed_directions(active));
}

std::vector<char> FixedVertices::moving() const {
  std::vector<char> moving(dofs_.vertex_count());
  for (int v = 0; v < dofs_.vertex_count(); ++v) moving[v] = dofs_.moves(v);
  return moving;
}

void FixedVertices::place(double t, VecX& x) const {
  prescribed_motion_.place(active_, rest_, anchor_, t, x);
  if (dofs_.dependents().empty()) return;
  const VecX placed = x;
  dofs_.follow(x);
  for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i) {
    if (!active_[i] || prescribed_motion_.assignments()[i].motion->partial()) continue;
    for (const int v : prescribed_motion_.assignments()[i].vertices) check_followed(prescribed_motion_.assignments()[i], v, placed, x);
  }
  check_joints(constraints_.joints(), x);
}

void FixedVertices::commit(State& state) {
  if (active_ == state.motion_active && state.x_motion_start.size() > 0) return;
  state.motion_active = active_;
  state.x_motion_start = anchor_;
}

int FixedVertices::straight_parts(double t, double h) const {
  constexpr int most = 64;
  const auto turns = [&](double from, double until) {
    VecX start = rest_, end = rest_;
    place(from, start);
    place(until, end);
    for (size_t i = 0; i < prescribed_motion_.assignments().size(); ++i) {
      const PrescribedMotion::Assignment& assignment = prescribed_motion_.assignments()[i];
      const bool turning = active_[i] && assignment.motion->moves() && assignment.motion->rigid();
      if (turning && more_than_a_quarter(assignment.vertices, start, end)) return true;
    }
    return false;
  };
  int parts = 1;
  for (int i = 0; i < parts && parts < most; ++i)
    if (turns(t + h * i / parts, t + h * (i + 1) / parts)) parts *= 2, i = -1;
  return parts;
}

bool FixedVertices::may_move() const {
  const auto& partly = dofs_.held_blocks();
  return std::any_of(held_.begin(), held_.end(), [&](int v) { return prescribed_motion_.may_move(v); }) ||
         std::any_of(partly.begin(), partly.end(), [&](const auto& h) { return prescribed_motion_.moves(dofs_.vertex_of_block(h.block)); });
}

}  // namespace tack
