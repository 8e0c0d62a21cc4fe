#include "solvers/lcp/lcp_records.hpp"

#include <cmath>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/contact/surface/lagged_surface.hpp"

namespace tack {
namespace {

enum class Direction { normal, across };

// Force of a contact on its point.
Vec3 force_of(const ContactRow& c, Direction direction) {
  const Vec3 normal = c.normal.dot(c.force) * c.normal;
  return direction == Direction::normal ? normal : Vec3(c.force - normal);
}

ForceRecord forces(std::shared_ptr<const LcpStep> step, const std::string& name, Direction direction, std::vector<std::string> summands) {
  ForceRecord record{name, direction == Direction::normal ? ForceDirection::normal : ForceDirection::tangential, std::move(summands)};
  record.stored = false;
  // In both kinds of forces the second term is adhesion, which bonds report.
  const auto none = [](std::string_view summand) { return summand == "adhesion"; };
  record.add = [=](const VecX&, std::string_view summand, VecX& sum) {
    if (none(summand)) return;
    for (const ContactRow& c : step->contacts())
      for (int i = 0; i < 4; ++i) vertex(sum, c.vertices[i]) += c.coefficients[i] * force_of(c, direction);
  };
  record.between = [=](const VecX&, std::string_view summand, ObjectPair pair) {
    Vec3 sum = Vec3::Zero();
    if (none(summand)) return sum;
    for (const ContactRow& c : step->contacts()) {
      if (c.object == pair.a && c.opposite == pair.b) sum += force_of(c, direction);
      else if (c.object == pair.b && c.opposite == pair.a) sum -= force_of(c, direction);
    }
    return sum;
  };
  return record;
}

}  // namespace

void publish_impulses(World& world, std::shared_ptr<const LcpStep> step) {
  if (!world.contact) return;
  ForceRecord normal = forces(step, "contact", Direction::normal, {"barrier", "adhesion"});
  normal.add_compressions = [=](const VecX&, std::string_view summand, VecX& compressions) {
    if (summand == "adhesion") return;
    for (const ContactRow& c : step->contacts())
      for (int i = 0; i < 4; ++i) compressions(3 * c.vertices[i]) += std::abs(c.coefficients[i]) * c.normal.dot(c.force);
  };
  // A point stands for a third of the triangles around it, wherever it carries pressure.
  normal.add_areas = [=, system = world.contact.get()](const VecX&, VecX& areas) {
    for (const ContactRow& c : step->contacts()) {
      if (c.own != 1 || c.force.isZero(0)) continue;
      const double area = system->lagged_surface().tributary_area(c.vertices[0]);
      for (int i = 0; i < 4; ++i) areas(3 * c.vertices[i]) += std::abs(c.coefficients[i]) * area;
    }
  };
  world.records.replace(std::move(normal));
  for (const char* name : {"barrier", "adhesion"})
    world.records.replace(EnergyRecord{name, EnergyKind::contact, [](const VecX&) { return 0.0; }});
  if (!world.friction) return;
  world.records.replace(forces(step, "friction", Direction::across, {"friction", "adhesion"}));
  for (const char* name : {"friction", "tangential_adhesion"})
    world.records.replace(EnergyRecord{name, EnergyKind::of_step, [](const VecX&) { return 0.0; }});
  world.records.replace(FlowRecord{"friction", {{"dissipated_friction"}, {"dissipated_adhesion"}}, [=](const VecX&, double* amounts) {
    amounts[0] = step->slid();
    amounts[1] = 0;
  }});
}

}  // namespace tack
