#include "framework/stepping/free_bodies.hpp"

#include <fmt/format.h>

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "framework/body/extent.hpp"

namespace tack {
namespace {

struct FreeGroup {
  Vec3 force = Vec3::Zero();  // N
  double tolerated = 0;       // N: what rounding may leave of it
  std::set<int> bodies;
};

// Returns whether a ray from the centre of `moving` along `direction` hits `other`, inflated by half the size of `moving`.
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
  std::map<int, FreeGroup> free;
  for (int b = 0; b < groups.blocks(); ++b) {
    if (groups.held(b)) continue;
    const int v = world.dofs.vertex_of_block(b), body = world.body_of(v);
    if (body < 0 || world.is_number(v)) continue;
    FreeGroup& group = free[groups.contact_group(b)];
    group.force -= gradient.segment<3>(3 * b);
    group.tolerated += groups.rounding(b);
    group.bodies.insert(body);
  }
  for (const auto& [first, group] : free) {
    constexpr double balanced = 1e-6;  // of the largest force on it
    if (group.force.norm() <= group.tolerated + balanced * groups.cause(first) || may_be_stopped(world, group, x)) continue;
    const auto component = [&](int i) { return std::abs(group.force(i)) > balanced * group.force.norm() ? group.force(i) : 0; };
    const std::string others = group.bodies.size() > 1 ? fmt::format(" and {} more that move with it", group.bodies.size() - 1) : "";
    throw FreeBody(fmt::format("nothing holds '{}'{} against the force ({:.4g}, {:.4g}, {:.4g}) N that acts on it, and nothing lies in its way: there is no equilibrium",
                               world.bodies[*group.bodies.begin()].name, others, component(0), component(1), component(2)));
  }
}

}  // namespace tack
