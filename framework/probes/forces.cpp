// Probes of forces: contact and adhesion between objects, and the reaction of what is held.
#include "framework/assembly/term_gradient.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The force that the second object exerts on the first, or all objects on one.
class ContactForce : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    f.text("on", on_, "the object that the force acts on").required();
    f.text("from", from_, "the object that exerts it; without it, all others together");
    f.choice("part", part_,
             {{"all", LawPart::all, "barrier and adhesion"},
              {"barrier", LawPart::barrier, "repulsion only"},
              {"adhesion", LawPart::adhesion, "attraction only"}},
             "which normal laws");
  }

  void prepare(const World& world) override {
    if (!world.contact)
      throw InputError("probe '" + name_ + "': the scene has no contact section");
    a_ = object_index(world, on_, name_);
    b_ = from_.empty() ? -1 : object_index(world, from_, name_);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    if (b_ >= 0) return world.contact_term->force_between(state.x, part_, {a_, b_});
    const VecX forces = world.contact_term->forces(state.x, part_);
    Vec3 sum = Vec3::Zero();
    const Body& body = world.bodies[a_];
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
      sum += vertex(forces, v);
    return sum;
  }

 private:
  std::string on_, from_;
  LawPart part_ = LawPart::all;
  int a_ = -1, b_ = -1;
};

// The force that makes held vertices stand still or move as their script says: against everything that
// acts on them, and their own inertia. Vertices that are free at present need none.
class Reaction : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    set_.fields(f);
  }
  void prepare(const World& world) override {
    set_.prepare(world, name_);
    for (const int v : set_.vertices())
      if (!world.script.ever_held(v))
        throw InputError("probe '" + name_ + "': a reaction needs held vertices, and some of these are "
                         "free; give the selection of the motion that holds them");
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    VecX gradient = VecX::Zero(state.x.size());
    for (const Term* term : world.terms) add_term_gradient(*term, state.x, gradient);
    Vec3 sum = Vec3::Zero();
    for (const int v : set_.vertices())
      if (world.dofs.block(v) < 0) sum += vertex(gradient, v) + world.mass(v) * vertex(state.a, v);
    return sum;
  }

 private:
  VertexSet set_;
};

TACK_REGISTER(Probe, ContactForce, "contact_force", "Normal contact force between objects [N].", "");
TACK_REGISTER(Probe, Reaction, "reaction", "The force that holds or drives a selection of held vertices [N].", "");

}  // namespace
}  // namespace tack
