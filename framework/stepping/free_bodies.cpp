#include "framework/stepping/free_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/body/extent.hpp"

namespace tack {
namespace {

constexpr double residual_per_force = 1e-6;  // of the reference force of a group

struct FreeGroup {
  Vec3 force = Vec3::Zero();  // along its free translations [N]
  double rounding = 0;        // rounding error of the force [N]
  Mat3 fixed = Mat3::Zero();  // sum of the projections onto fixed directions of vertices
  std::set<int> bodies;
  std::vector<int> blocks;
};

// Returns the contact groups without a fixed vertex, by their first blocks.
std::map<int, FreeGroup> free_groups(const World& world, const ForceGroups& groups, const VecX& gradient) {
  std::map<int, FreeGroup> free;
  for (int b = 0; b < groups.blocks(); ++b) {
    if (groups.supported(b)) continue;
    const int v = world.dofs.vertex_of_block(b), body = world.body_of(v);
    if (body < 0 || world.is_scalar_dof(v)) continue;
    FreeGroup& group = free[groups.contact_group(b)];
    group.force -= gradient.segment<3>(3 * b);
    group.rounding += groups.rounding(b);
    group.bodies.insert(body);
    group.blocks.push_back(b);
  }
  for (const DofMap::PartlyFixedBlock& h : world.dofs.partly_fixed_blocks())
    if (const auto group = free.find(groups.contact_group(h.block)); !h.scalar && group != free.end()) group->second.fixed += h.projection;
  for (auto& [first, group] : free) {
    if (group.fixed.isZero(0)) continue;
    constexpr double free_eigenvalue = 1e-9;  // of an eigenvalue: projections have 0 and 1
    const Eigen::SelfAdjointEigenSolver<Mat3> directions(group.fixed);
    Vec3 along = Vec3::Zero();
    for (int i = 0; i < 3; ++i)
      if (const Vec3 d = directions.eigenvectors().col(i); directions.eigenvalues()(i) < free_eigenvalue) along += d * d.dot(group.force);
    group.force = along;
  }
  return free;
}

double force_limit(const ForceGroups& groups, int first, const FreeGroup& group) { return group.rounding + residual_per_force * groups.reference_force(first); }

// Returns "'cube' and 2 more that move with it".
std::string names_of(const World& world, const FreeGroup& group) {
  const std::string others = group.bodies.size() > 1 ? fmt::format(" and {} more that move with it", group.bodies.size() - 1) : "";
  return fmt::format("'{}'{}", world.bodies[*group.bodies.begin()].name, others);
}

// Returns "(0, -9.81, 0)", without round-off.
std::string text_of(const Vec3& a) {
  const auto component = [&](int i) { return std::abs(a(i)) > residual_per_force * a.norm() ? a(i) : 0; };
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", component(0), component(1), component(2));
}

// Returns whether a ray from the centre of `moving` along `direction` hits `other`, inflated by
// half the size of `moving`.
bool lies_ahead(const Eigen::AlignedBox3d& moving, const Vec3& direction, const Eigen::AlignedBox3d& other) {
  const Vec3 centre = moving.center(), half = moving.sizes() / 2;
  double first = 0, last = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    const double low = other.min()(i) - half(i) - centre(i), high = other.max()(i) + half(i) - centre(i);
    if (direction(i) == 0) {
      if (low > 0 || high < 0) return false;
      continue;
    }
    first = std::max(first, std::min(low / direction(i), high / direction(i)));
    last = std::min(last, std::max(low / direction(i), high / direction(i)));
  }
  return first <= last;
}

bool may_be_stopped(const World& world, const FreeGroup& group, const VecX& x) {
  if (!world.contact) return false;
  Eigen::AlignedBox3d moving;
  for (const int i : group.bodies) moving.extend(extent_of(world.bodies[i], x));
  const Vec3 direction = group.force.normalized();
  for (size_t i = 0; i < world.bodies.size(); ++i)
    if (!group.bodies.contains(static_cast<int>(i)) && lies_ahead(moving, direction, extent_of(world.bodies[i], x))) return true;
  return false;
}

}  // namespace

void check_free_bodies(const World& world, const ForceGroups& groups, const VecX& x, const VecX& gradient) {
  for (const auto& [first, group] : free_groups(world, groups, gradient)) {
    if (group.force.norm() <= force_limit(groups, first, group) || may_be_stopped(world, group, x)) continue;
    throw FreeBody(fmt::format("nothing supports {} against the force {} N that acts on it, and no obstacle lies ahead: there is no equilibrium",
                               names_of(world, group), text_of(group.force)));
  }
}

std::vector<Warning> turning_bodies(const World& world, const ForceGroups& groups, const VecX& x, const VecX& gradient) {
  std::vector<Warning> warnings;
  for (const auto& [first, group] : free_groups(world, groups, gradient)) {
    if (!group.fixed.isZero(0) || group.force.norm() > force_limit(groups, first, group)) continue;
    Vec3 centre = Vec3::Zero(), torque = Vec3::Zero();
    for (const int b : group.blocks) centre += vertex(x, world.dofs.vertex_of_block(b)) / static_cast<double>(group.blocks.size());
    double size = 0;
    for (const int b : group.blocks) {
      const Vec3 arm = vertex(x, world.dofs.vertex_of_block(b)) - centre;
      size = std::max(size, arm.norm());
      torque -= arm.cross(gradient.segment<3>(3 * b));
    }
    if (torque.norm() <= size * force_limit(groups, first, group)) continue;
    warnings.emplace_back(WarningKind::free_rotation, fmt::format("nothing prevents {} from rotating under the torque {} N m that acts on it: without inertia there is an equilibrium only where "
                                "the torque vanishes by the rotation; {}", names_of(world, group), text_of(torque), FreeBody::remedy));
  }
  return warnings;
}

}  // namespace tack
