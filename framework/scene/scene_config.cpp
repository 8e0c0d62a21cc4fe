#include "framework/scene/scene_config.hpp"

#include <fmt/format.h>

#include "framework/bond/bond_law.hpp"

namespace tack {

// Listed though the program may have none of its own.
[[maybe_unused]] static const Kind& interactions = Registry<Interaction>::kind();

void NamedSelection::fields(Fields& f) {
  f.text("name", name, "what selections of type tag call it").required().line();
  f.component("select", select, "its vertices").required();
}

void SurfaceConfig::fields(Fields& f) {
  f.number("edge_length", edge_length, units::length,
           "its triangles are divided until no edge is longer; new vertices follow the corners of the triangle that they lie in")
      .required().positive();
}

void ShellConfig::fields(Fields& f) {
  f.number("thickness", thickness, units::length, "of its triangles, which stand for the middle of the sheet").required().positive();
}

void ObjectConfig::fields(Fields& f) {
  f.text("name", name, "what pairs, probes and messages call it").required().line();
  f.texts("groups", groups, "names under which pairs may mean it together with others").line();
  f.component("shape", shape, "mesh").required();
  f.object("place", place, "scale, rotate, translate the mesh");
  f.choice("elements", elements,
           {{"linear", Elements::linear, "each tet by itself: few over a thickness hardly bend, and volume locks with a Poisson's ratio near 1/2"},
            {"composite", Elements::composite, "every tet becomes one of ten nodes, made of eight: its edges are halved, and the middles are vertices like all "
             "others. Bends with one cell over a thickness, and volume does not lock"},
            {"patches", Elements::patches, "linear tets of which neighbours (in boxes, cylinders and spheres the six of a cell) share their change of volume, which "
             "then does not lock; no new vertices, but hardly better at bending"}},
           "what the energies of its tets make of them");
  f.optional_object("fill", fill, "many copies of it in a region, at random");
  f.list("selections", selections, "vertices with a name, for `select: {type: tag, name: ...}` in motion, loads and probes");
  f.optional_object("surface", surface, "what contact sees, finer than the mesh; unless given, the surface of the mesh");
  f.optional_object("shell", shell, "its triangles that are no faces of tets are a thin sheet, as membranes and bending energies need it");
  f.optional_object("rod", rod, "the section of its edges");
  f.optional_object("particle", particle, "the size of its points");
  f.number("contact_offset", contact_offset, units::length,
           "how far in front of what is meshed its contact surface lies, on every side: half the thickness of a shell, the radius of "
           "a rod or particle").nonnegative();
  f.component("body", body, "how it may move as a whole; unless given, its vertices are free");
  f.component_list("energies", energies, "its potential energies; one that motions hold throughout, or an affine body, needs none");
  f.optional_object("damping", damping, "resistance to motion, C = mass M + stiffness K (Rayleigh); not with quasi-static steps");
  f.optional_object("remesh", remesh, "tets that plastic flow has made flat or long are exchanged for better ones between steps, inside the same surface; of von_mises. Unless given, they stay");
  f.component_list("motion", motion, "prescribed motion of some vertices");
  f.list("attach", attach, "vertices that follow another object; where the two touch at the start they are in no contact, then or later");
  f.component_list("loads", loads, "external forces");
  f.vector("velocity", velocity, units::velocity, "initial velocity of what is free of it");
  f.vector("spin", spin, units::angular_velocity, "initial angular velocity of what is free of it, about its centre of mass");
}

void PairSide::fields(Fields& f) {
  f.text("object", object, "an object, a group of objects, or \"*\"").required();
  f.component("select", select, "of an object, a part: the triangles, edges and points all of whose vertices are chosen; all of it unless given");
  f.bare("object");
}

std::string PairSide::text() const { return select ? fmt::format("'{}' ({})", object, select->type()) : "'" + object + "'"; }

bool PairConfig::bonds() const { return dynamic_cast<const BondLaw*>(adhesion.get()) != nullptr; }

void PairConfig::fields(Fields& f) {
  f.list("between", between, "two names, of an object or of a group of them, or \"*\" for all; the same object twice for contact of it with "
         "itself; or a part of an object, {object: NAME, select: ...}. Where several entries fit, two objects hold before an object and a group, an object and \"*\", "
         "two groups, a group and \"*\", twice \"*\"; of those that are equal in this, two parts before one, and that before none")
      .required();
  f.flag("contact", contact, "false: the two may pass through each other");
  f.component("barrier", barrier, "repulsion of this pair, instead of the common one");
  f.component("adhesion", adhesion, "attraction; pairs that are not named do not adhere");
  f.choice("bond", bond,
           {{"automatic", Bonding::automatic, "as the law has it: on_contact of one that heals, at_start of others"},
            {"at_start", Bonding::at_start, "what lies opposite the other at the start of a run; what has parted does not bond again"},
            {"on_contact", Bonding::on_contact, "whatever comes to lie opposite the other, wherever there is no bond (any more)"}},
           "of an adhesion by bonds: when they are made");
  f.optional_number("bond_distance", bond_distance, units::length,
                    "the largest gap at which bonds are made; the contact distance unless given, at most twice that").positive();
  f.choice("unstressed", unstressed,
           {{"as_bonded", Unstressed::as_bonded, "at the gap at which it was made"},
            {"touching", Unstressed::touching, "where the surfaces touch: the law's opening is the gap"}},
           "of an adhesion by bonds: from where the opening of a bond counts");
  f.optional_object("friction", friction, "friction of this pair, instead of the common one");
  f.optional_object("tangential_adhesion", tangential_adhesion,
                    "resistance to sliding within reach of the adhesion, which it needs");
  f.text("integrate", integrate,
         "whose surface the pressure is integrated over: automatic (with adhesion the side with more of its area "
         "opposite the other, or where both have as much the one with more points there; without adhesion both, by "
         "the sizes of their cells), finer (the side with the finer surface), both (half each), or one of the two names. "
         "Between a surface and a rod or particle it is always the latter's width or cross-section");
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
  f.check("unstressed", [this, of_bonds] { return of_bonds(unstressed != Unstressed::as_bonded); });
}

void ContactConfig::fields(Fields& f) {
  f.number("distance", contact_distance, units::length, "dhat_b: gap below which surfaces repel").positive();
  f.component("barrier", barrier, "repulsion of every pair");
  f.optional_number("guard", guard, units::none,
                    "range, in contact distances, of the pairs that only keep surfaces apart (edge-edge, and points of the side that "
                    "pressure is not integrated over); by default 0.5, and 1 for soft bodies that may fly or fall faster than waves run in them")
      .range(0.01, 1);
  f.choice("weights", weights,
           {{"area", Weights::area, "surface integrals that do not depend on the mesh"},
            {"pair", Weights::pair, "every close pair counts, as in plain IPC; strength depends on the mesh"}},
           "how pairs are weighted");
  f.flag("between_held", between_held,
         "whether objects that motions hold throughout are kept from meeting one another; false: they may overlap");
  f.optional_number("push_out", push_out, units::length,
                    "objects that overlap at the start, or are closer than their offsets, are moved apart, none farther than this, to a gap "
                    "of half the contact distance; those stay that motions hold, that are attached, or that an interaction joins. Unless given, "
                    "such a start is refused").positive();
  f.optional_object("friction", friction, "friction of every pair");
  f.object("lagging", lagging, "how friction follows the normal forces within a step");
  f.list("pairs", pairs, "what differs between two objects");
}

void StartConfig::fields(Fields& f) {
  f.path("from", from, "a checkpoint (output.checkpoint_interval), or the folder of a run: its newest").required();
  f.texts("objects", objects, "or groups of them; empty: all that both scenes have. Others start as the scene says. Their meshes must be the "
          "same; what they remember (plastic strain, twist) is taken along");
  f.flag("velocities", velocities, "false: they start at rest");
}

void SceneConfig::fields(Fields& f) {
  f.vector("gravity", gravity, units::acceleration, "acceleration of every mass");
  f.list("objects", objects, "what is simulated").required().nonempty();
  f.list("selections", selections, "as those of an object, of all objects of which they choose a vertex");
  f.component_list("interactions", interactions, "what acts between objects, on vertices of them, or on one");
  f.optional_object("contact", contact, "contact between all objects; without it there is none");
  f.optional_object("start", start, "objects that an earlier run has moved start as they were at one of its checkpoints, at time 0");
  f.check("start", [this]() -> std::string {
    return start && contact && contact->push_out ? "places objects, as contact.push_out does; take one of them out" : "";
  });
}

}  // namespace tack
