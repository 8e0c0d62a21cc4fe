#include "framework/output/frame_fields.hpp"

#include "framework/contact/contact_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/bond/bond_term.hpp"
#include "framework/contact/rim_term.hpp"
#include "framework/core/state.hpp"
#include "framework/output/bond_fields.hpp"
#include "framework/output/vertex_gaps.hpp"
#include "framework/output/vertex_tractions.hpp"
#include "framework/scene/world.hpp"

namespace tack {

const std::vector<FrameFieldInfo>& frame_fields() {
  static const std::vector<FrameFieldInfo> all{
      {"velocity", "m/s", "", false},
      {"displacement", "m", "from where the scene puts it", false},
      {"mass", "kg", "", false},
      {"contact_force", "N", "barrier and adhesion", false},
      {"adhesion_force", "N", "", false},
      {"friction_force", "N", "with tangential adhesion", false},
      {"contact_pressure", "Pa", "contact force per area of the contact: positive presses, negative pulls; of sheets, of both sides together", false},
      {"adhesion_pressure", "Pa", "likewise of adhesion alone, positive where it pulls", false},
      {"friction_traction", "Pa", "magnitude of the friction force per area of the contact", false},
      {"gap", "m", "to the nearest of what is within reach of contact; not a number where nothing is", false},
      {"bond_intensity", "", "of bonds: 1 where all are whole; not a number where there are none", false},
      {"bond_traction", "Pa", "magnitude of the force of bonds per area", false},
      {"cauchy_stress", "Pa", "xx, yy, zz, xy, yz, xz, of all energies of the element together; of sheets, in their middle", true},
      {"von_mises_stress", "Pa", "of the same", true},
      {"stretches", "", "principal ones, largest first: three of a tet, two of a triangle, one of an edge", true},
      {"plastic_strain", "", "accumulated", true}};
  return all;
}

namespace {

VecX collected(const World& world, VecX forces) {
  world.collect_on_meshes(forces);
  return forces;
}

// One by its name; empty if the scene has nothing of the kind.
VecX values_of(const std::string& name, const World& world, const State& state) {
  if (name == "velocity") return state.v;
  if (name == "displacement") return state.x - world.rest;
  if (name == "mass") return world.mass;
  if (!world.contact_term) return {};
  if (name.starts_with("bond_")) {
    if (!world.bonds) return {};
    return name == "bond_intensity" ? bond_intensities(world) : bond_tractions(world, state.x);
  }
  if (name == "gap") return vertex_gaps(*world.contact, state.x);
  const bool friction = name.starts_with("friction");
  if (friction && !world.friction) return {};
  const LawPart part = name.starts_with("adhesion") ? LawPart::adhesion : LawPart::all;
  VecX forces = friction ? world.friction->forces(state.x, TangentialPart::all) : world.contact_term->forces(state.x, part);
  if (world.rim && !friction) forces += world.rim->forces(state.x, part);
  if (world.bonds && !friction) forces += world.bonds->forces(state.x, part);
  forces = collected(world, std::move(forces));
  if (name.ends_with("force")) return forces;
  if (friction) return tangential_tractions(world, state.x, forces);
  return (part == LawPart::all ? 1 : -1) * normal_pressures(world, state.x, forces, part);
}

}  // namespace

std::vector<PointField> vertex_fields(const std::vector<std::string>& names, const World& world, const State& state,
                                      const FrameGeometry& geometry) {
  std::vector<PointField> fields;
  for (const std::string& name : names)
    for (const FrameFieldInfo& info : frame_fields()) {
      if (info.name != name || info.of_elements) continue;
      VecX values = values_of(name, world, state);
      if (values.size() == 0) continue;
      const int components = values.size() == world.rest.size() ? 3 : 1;
      values.conservativeResize(components * geometry.vertices);  // vertices that are in no mesh are not shown
      fields.push_back({name, components, std::move(values), info.unit});
    }
  return fields;
}

}  // namespace tack
