#include "framework/run/exact_check.hpp"

#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {
namespace {

constexpr int counted_max = 100;

}  // namespace

int intersections_at(const World& world, const VecX& x) {
  int count = first_inverted_tet(world.tets, x) >= 0 ? 1 : 0;
  if (world.contact) count += static_cast<int>(find_intersections(world.contact->surface().mesh, x, world.contact->colliding(), counted_max).size());
  return count;
}

}  // namespace tack
