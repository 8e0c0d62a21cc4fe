#include "framework/scene/scene_config.hpp"

#include <fmt/format.h>

#include "framework/bond/bond_law.hpp"

namespace tack {

// Registers the kind even if the program has no interaction of its own.
[[maybe_unused]] static const Kind& interactions = Registry<Interaction>::kind();

void NamedSelection::fields(Fields& f) {
  f.text("name", name, "name for selections of type tag").required().line();
  f.component("select", select, "selected vertices").required();
}

void SurfaceConfig::fields(Fields& f) {
  f.number("edge_length", edge_length, units::length,
           "largest edge length, to which its triangles are divided; new vertices follow the corners of the triangle that they lie in")
      .required().positive();
}

void ShellConfig::fields(Fields& f) {
  f.number("thickness", thickness, units::length, "thickness; the triangles are the mid-surface").required().positive();
}

void ObjectConfig::fields(Fields& f) {
  f.text("name", name, "name in pairs, probes and messages").required().line();
  f.texts("groups", groups, "names of groups of objects, for use in pairs").line();
  f.component("shape", shape, "mesh").required();
  f.object("place", placement, "scale, rotate, translate the mesh");
  f.choice("elements", elements,
           {{"linear", Elements::linear, "linear tets: too stiff in bending with few over a thickness; volumetric locking with a Poisson's ratio "
                                         "near 1/2"},
            {"composite", Elements::composite, "composite ten-node tets: every tet is divided into eight, with the "
                                               "midpoints of its edges as new vertices. Accurate bending with one "
                                               "cell over a thickness; no volumetric locking"},
            {"patches", Elements::patches, "linear tets; neighbours (in boxes, cylinders and spheres the six of a "
                                           "cell) share their change of volume. No volumetric locking and no new "
                                           "vertices, but bending hardly improves"}},
           "element type of its tets");
  f.optional_object("fill", fill, "random copies of it in a region");
  f.list("selections", selections, "named sets of vertices, for `select: {type: tag, name: ...}` in motion, loads and probes");
  f.optional_object("surface", surface, "contact surface finer than the mesh; the surface of the mesh unless given");
  f.optional_object("shell", shell, "thin sheet: its triangles that are not faces of tets, for membrane and bending energies");
  f.optional_object("rod", rod, "cross-section of its edges");
  f.optional_object("particle", particle, "the size of its points");
  f.number("contact_offset", contact_offset, units::length,
           "distance of its contact surface from the mesh, on every side: half the thickness of a shell, the radius "
           "of a rod or particle").nonnegative();
  f.optional_number("friction", friction, units::none,
                    "coefficient of friction of its surface: two objects that have one rub with both, combined by contact.blend, unless their pair names its friction").nonnegative();
  f.optional_vector("grain", grain, units::none, "direction of the grain of its surface, as it is placed, for friction with mu_across; it turns with the material");
  f.check("grain", [this]() -> std::string { return grain && !(grain->norm() > 0) ? "is a direction, and has no length" : ""; });
  f.component("body", body, "kinematics as a whole; unless given, its vertices move freely");
  f.component_list("energies", energies, "its potential energies; not needed by an affine body or if all its motion is prescribed");
  f.optional_object("damping", damping, "resistance to motion, C = mass M + stiffness K (Rayleigh); not with quasi-static steps");
  f.optional_object("remesh", remesh, "remesh tets that plastic flow (von_mises) has distorted, between steps and inside the same surface; none "
                                      "unless given");
  f.component_list("motion", motion, "prescribed motion of some vertices");
  f.list("attach", attach, "vertices attached to another object (multi-point constraint); where the two touch at the start they have no contact, "
                           "then or later");
  f.component_list("loads", loads, "external forces");
  f.vector("velocity", velocity, units::velocity, "initial velocity of its free vertices");
  f.vector("spin", spin, units::angular_velocity, "initial angular velocity of its free vertices, about its centre of mass");
}

void PairSide::fields(Fields& f) {
  f.text("object", object, "an object, a group of objects, or \"*\"").required();
  f.component("select", select, "region of an object: the triangles, edges and points with all vertices selected; all of it unless given");
  f.bare("object");
}

std::string PairSide::text() const { return select ? fmt::format("'{}' ({})", object, select->type()) : "'" + object + "'"; }

bool PairConfig::bonds() const { return dynamic_cast<const BondLaw*>(adhesion.get()) != nullptr; }

void PairConfig::fields(Fields& f) {
  f.list("between", between, "two names of objects or groups, or \"*\" for all; an object twice for self-contact; or "
                             "a region of an object, {object: NAME, select: ...}. The most specific entry applies, "
                             "in the order: two objects; object and group; object and \"*\"; two groups; group and "
                             "\"*\"; \"*\" twice. Among equals, two regions precede one, and one precedes none")
      .required();
  f.flag("contact", contact, "false: the two may pass through each other");
  f.component("barrier", barrier, "repulsion of this pair, instead of the common one");
  f.component("adhesion", adhesion, "adhesion law; pairs without one do not adhere");
  f.choice("bond", bond,
           {{"automatic", Bonding::automatic, "on_contact for laws that heal, at_start for others"},
            {"at_start", Bonding::at_start, "surfaces that face each other at the start of a run; separated surfaces do not bond again"},
            {"on_contact", Bonding::on_contact, "surfaces that come to face each other, wherever there is no bond"},
            {"first_contact", Bonding::first_contact, "as on_contact, but each point of the integration side once with an object: what has separated does not bond again"}},
           "for adhesion by bonds: when bonds form");
  f.optional_number("bond_distance", bond_distance, units::length,
                    "largest gap at which bonds form; the contact distance unless given, at most twice that").positive();
  f.optional_number("bond_pressure", bond_pressure, units::pressure,
                    "pressure of the barrier below which new bonds do not form; none unless given").nonnegative();
  f.choice("unstressed", unstressed,
           {{"as_bonded", Unstressed::as_bonded, "the gap at which the bond formed"},
            {"touching", Unstressed::touching, "zero gap: the opening is the gap"}},
           "for adhesion by bonds: zero of the bond opening");
  f.optional_object("friction", friction, "friction of this pair, instead of the common one");
  f.optional_object("tangential_adhesion", tangential_adhesion,
                    "resistance to sliding within the adhesion range; needs an adhesion law");
  f.text("integrate", integrate,
         "integration (secondary) side of the contact integral: automatic (with adhesion the side with more area "
         "that faces the other, if equal the one with more points there; without adhesion both, weighted by the "
         "sizes of their cells), finer (the side with the finer surface), both (half each), or one of the two names. "
         "Between a surface and a rod or particle it is always the width or cross-section of the latter");
  f.text("drive", drive, "drive of a protocol: factor of the adhesion over time, 1 until a stage sets it").line();
  f.check("drive", [this]() -> std::string {
    if (drive.empty()) return "";
    if (!adhesion) return "is the factor of an adhesion, and this pair has none; give one";
    if (bonds()) return "cannot change an adhesion by bonds, whose strength is history; take a traction-separation law (tack list adhesion)";
    return tangential_adhesion ? "does not change a tangential_adhesion, which takes its strength from the adhesion; take one of the two away" : "";
  });
  f.check("between", [this]() -> std::string {
    return between.size() == 2 ? "" : "expects two names";
  });
  f.check("tangential_adhesion", [this]() -> std::string {
    if (tangential_adhesion && bonds()) return "is no part of an adhesion by bonds, whose laws resist slip themselves; drop it";
    return !tangential_adhesion || adhesion
               ? "" : "takes its strength from the pair's adhesion, and there is none; give one";
  });
  const auto of_bonds = [this](bool given) -> std::string {
    return !given || bonds() ? "" : "is of an adhesion by bonds, and this pair has none: drop it, or choose such an adhesion (tack list adhesion)";
  };
  f.check("bond", [this, of_bonds] { return of_bonds(bond != Bonding::automatic); });
  f.check("bond_distance", [this, of_bonds] { return of_bonds(bond_distance.has_value()); });
  f.check("bond_pressure", [this, of_bonds] { return of_bonds(bond_pressure.has_value()); });
  f.check("unstressed", [this, of_bonds] { return of_bonds(unstressed != Unstressed::as_bonded); });
}

void ContactConfig::fields(Fields& f) {
  f.number("distance", contact_distance, units::length, "dhat_b: gap below which surfaces repel").positive();
  f.component("barrier", barrier, "repulsion of every pair");
  f.optional_number("safety_barrier", safety_barrier, units::none,
                    "range, in contact distances, of safety-barrier pairs, which only prevent intersection "
                    "(edge-edge, and points of the side that is not integrated); by default 0.5, and 1 for soft "
                    "bodies that may fly or fall faster than their wave speed")
      .range(0.01, 1);
  f.component("model", model, "how close surfaces become a potential");
  f.choice("weights", weights,
           {{"area", Weights::area, "model: area_integral"}, {"pair", Weights::pair, "model: ipc"}},
           "weighting of pairs").deprecated("contact.model: ipc is `pair`, area_integral is `area`");
  f.choice("integral", integral,
           {{"lagged", Integral::lagged, "model: area_integral"}, {"clipped", Integral::clipped, "model: clipped"}},
           "integral of adhesion over surfaces").deprecated("contact.model: clipped is `clipped`, area_integral is `lagged`");
  f.flag("between_prescribed", between_prescribed,
         "contact between objects whose motion is prescribed throughout; false: they may overlap");
  f.optional_number("overclosure_adjustment", overclosure_adjustment, units::length,
                    "overclosure adjustment: objects that overlap at the start, or are closer than their offsets, "
                    "are moved apart by at most this distance, to a gap of half the contact distance; objects that "
                    "are prescribed, attached or joined by an interaction stay. Unless given, such a start is refused").positive();
  f.optional_object("friction", friction, "friction of every pair");
  f.choice("blend", blend,
           {{"geometric", FrictionBlend::geometric, "the square root of their product"},
            {"arithmetic", FrictionBlend::arithmetic, "their mean"},
            {"harmonic", FrictionBlend::harmonic, "twice their product over their sum"},
            {"minimum", FrictionBlend::minimum, "the smaller one"},
            {"maximum", FrictionBlend::maximum, "the larger one"},
            {"product", FrictionBlend::product, "their product"}},
           "coefficient of friction of two surfaces with coefficients of their own (objects[].friction)");
  f.object("lagging", lagging, "updates of the lagged normal forces of friction within a step");
  f.list("pairs", pairs, "contact settings of pairs of objects");
  f.check("weights", [this] { return weights == Weights::pair ? replace_model("ipc") : std::string(); });
  f.check("integral", [this] { return integral == Integral::clipped ? replace_model("clipped") : std::string(); });
}

// Sets the model that a deprecated key stands for. Returns the error if another key names another one.
std::string ContactConfig::replace_model(const char* name) {
  if (model->type() == name) return "";
  if (model->type() != "area_integral") return fmt::format("stands for contact.model: {}, and the model is {}; take one of them out", name, model->type());
  model = Registry<ContactModel>::make(name);
  return "";
}

void StartConfig::fields(Fields& f) {
  f.path("from", from, "a checkpoint (output.checkpoint_interval), or the folder of a run: its newest").required();
  f.texts("objects", objects, "objects or groups; empty: all that both scenes have. Others start as the scene says. "
                              "Their meshes must be the same; history variables (plastic strain, twist) are taken "
                              "over");
  f.flag("velocities", velocities, "false: they start at rest");
}

void SceneConfig::fields(Fields& f) {
  f.vector("gravity", gravity, units::acceleration, "acceleration of every mass");
  f.list("objects", objects, "simulated objects").required().nonempty();
  f.list("selections", selections, "named sets of vertices as those of an object, for all objects in which they select a vertex");
  f.component_list("interactions", interactions, "joints, springs, ropes, fluid cavities and other connections of objects");
  f.optional_object("contact", contact, "contact between all objects; without it there is none");
  f.list("protocols", protocols, "how a laboratory runs a test: stages with what moves, until when, and what comes next");
  f.optional_object("environment", environment, "temperature, for adhesion laws and energies that depend on it; 293.15 K unless given");
  f.optional_object("start", start, "initial state from a run: objects start at time 0 in the state of a checkpoint of that run");
  f.check("start", [this]() -> std::string {
    return start && contact && contact->overclosure_adjustment ? "places objects, as contact.overclosure_adjustment does; take one of them out" : "";
  });
}

}  // namespace tack
