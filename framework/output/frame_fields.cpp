#include "framework/output/frame_fields.hpp"

#include <cctype>
#include <stdexcept>

#include "framework/core/published_field.hpp"
#include "framework/core/state.hpp"
#include "framework/output/vertex_gaps.hpp"
#include "framework/output/vertex_tractions.hpp"
#include "framework/world/world.hpp"

namespace tack {

std::vector<FrameFieldInfo> frame_fields() {
  std::vector<FrameFieldInfo> all{
      {"velocity", "m/s", "", false},
      {"displacement", "m", "from the initial position", false},
      {"mass", "kg", "", false},
      {"contact_force", "N", "barrier and adhesion", false},
      {"adhesion_force", "N", "", false},
      {"friction_force", "N", "with tangential adhesion", false},
      {"contact_pressure", "Pa", "contact force per contact area: positive is compression, negative tension; for sheets the sum of both sides", false},
      {"adhesion_pressure", "Pa", "adhesion force per contact area, positive in tension", false},
      {"friction_traction", "Pa", "magnitude of the friction force per area of the contact", false},
      {"gap", "m", "distance to the nearest surface within the contact range; not a number if there is none", false},
      {"cauchy_stress", "Pa", "xx, yy, zz, xy, yz, xz, sum of all energies of the element; for sheets, in the mid-surface", true},
      {"von_mises_stress", "Pa", "von Mises equivalent of cauchy_stress", true},
      {"stretches", "", "principal stretches, largest first: three for a tet, two for a triangle, one for an edge", true}};
  const auto in_a_list = [](std::string sentence) {
    sentence[0] = static_cast<char>(std::tolower(static_cast<unsigned char>(sentence[0])));
    sentence.pop_back();
    return sentence;
  };
  for (const auto& [name, entry] : Registry<PublishedField>::kind().entries()) {
    const auto field = entry.factory();
    const auto& published = dynamic_cast<const PublishedField&>(*field);
    all.push_back({name, published.unit(), in_a_list(entry.doc), published.of_elements(), published.components()});
  }
  return all;
}

namespace {

// A field of frames that is made of published forces.
struct ForceField {
  const char* name;
  ForceDirection direction;
  std::string_view summand;
  enum { force, pressure, traction } quantity;
};
constexpr ForceField force_fields[] = {{"contact_force", ForceDirection::normal, "", ForceField::force},
                                  {"adhesion_force", ForceDirection::normal, "adhesion", ForceField::force},
                                  {"friction_force", ForceDirection::tangential, "", ForceField::force},
                                  {"contact_pressure", ForceDirection::normal, "", ForceField::pressure},
                                  {"adhesion_pressure", ForceDirection::normal, "adhesion", ForceField::pressure},
                                  {"friction_traction", ForceDirection::tangential, "", ForceField::traction}};

VecX values_of(const ForceField& field, const World& world, const VecX& x) {
  if (!world.records.has_forces(field.direction)) return {};
  VecX forces = VecX::Zero(x.size());
  world.records.add_forces(field.direction, x, field.summand, forces);
  world.collect_on_meshes(forces);
  if (field.quantity == ForceField::force) return forces;
  if (field.quantity == ForceField::traction) return tangential_tractions(world, x, forces);
  return (field.summand.empty() ? 1 : -1) * normal_pressures(world, x, forces, field.summand);
}

// Returns the field published under that name, combined over all its publishers; empty if there is
// none.
VecX published(const std::string& name, const World& world, const VecX& x) {
  VecX all;
  for (const FieldRecord& field : world.records.fields()) {
    if (field.name != name || field.of_elements) continue;
    const VecX values = field.values(x);
    const bool fits = all.size() == 0 ? values.size() == x.size() || 3 * values.size() == x.size() : values.size() == all.size();
    if (!fits) throw std::logic_error("the field '" + name + "' has not one number, or three, for each vertex");
    if (all.size() == 0) all = values;
    else for (Eigen::Index i = 0; i < all.size(); ++i) field.combine(values(i), all(i));
  }
  return all;
}

// Returns a field by its name; empty if the scene has none.
VecX values_of(const std::string& name, const World& world, const State& state) {
  for (const ForceField& field : force_fields)
    if (field.name == name) return values_of(field, world, state.x);
  if (name == "velocity") return state.v;
  if (name == "displacement") return state.x - world.rest;
  if (name == "mass") return world.mass;
  if (name == "gap") return world.contact ? vertex_gaps(*world.contact, state.x) : VecX();
  return published(name, world, state.x);
}

}  // namespace

std::vector<PointField> vertex_fields(const std::vector<std::string>& names, const World& world, const State& state,
                                      const FrameGeometry& geometry) {
  const std::vector<FrameFieldInfo> known = frame_fields();
  std::vector<PointField> fields;
  for (const std::string& name : names)
    for (const FrameFieldInfo& info : known) {
      if (info.name != name || info.of_elements) continue;
      VecX values = values_of(name, world, state);
      if (values.size() == 0) continue;
      const int components = values.size() == world.rest.size() ? 3 : 1;
      values.conservativeResize(components * geometry.vertices);  // drops vertices without mesh
      fields.push_back({name, components, std::move(values), info.unit});
    }
  return fields;
}

}  // namespace tack
