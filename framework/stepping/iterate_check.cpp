#include "framework/stepping/iterate_check.hpp"

#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/world/describe_primitive.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"

namespace tack {

void IterateCheck::begin(int step, const std::string& stage) {
  step_ = step;
  stage_ = stage;
  iteration_ = -1;
  last_.resize(0);
}

void IterateCheck::check(const VecX& x) {
  if (iteration_ >= 0 && x == last_) return;
  const PhaseScope scope(clock_, Phase::check);
  last_ = x;
  ++iteration_;
  const std::string fault = describe_infeasibility(world_, x);
  if (fault.empty()) return;
  throw SimulationError(fmt::format("step {}, iteration {} of {}: {} {}", step_, iteration_, stage_, fault,
                                    found_by_iterate_check));
}

std::string describe_infeasibility(const World& world, const VecX& x) {
  if (const int tet = first_inverted_tet(world.tets, x); tet >= 0) {
    const Tet& v = world.tets[static_cast<size_t>(tet)];
    return describe_primitive(world, {v.begin(), v.end()}) + " is inverted";
  }
  if (!world.contact) return "";
  const CollisionMesh& mesh = world.contact->surface().mesh;
  const auto hits = find_intersections(mesh, x, world.contact->colliding(), 1);
  if (hits.empty()) return "";
  const Edge& e = mesh.edges[hits[0].edge];
  const Triangle& t = mesh.triangles[hits[0].triangle];
  return fmt::format("{} meets {}", describe_primitive(world, {e.begin(), e.end()}),
                     describe_primitive(world, {t.begin(), t.end()}));
}

}  // namespace tack
