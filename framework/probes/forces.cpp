// Probes of forces: contact and adhesion between objects, and the reaction of what is held.
#include "framework/assembly/term_gradient.hpp"
#include "framework/contact/contact_term.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/pair_force.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The force that the second object exerts on the first, or all objects on one.
class ContactForce : public PairForce<LawPart> {
 public:
  void fields(Fields& f) override {
    PairForce::fields(f);
    f.choice("part", part_,
             {{"all", LawPart::all, "barrier and adhesion"},
              {"barrier", LawPart::barrier, "repulsion only"},
              {"adhesion", LawPart::adhesion, "attraction only"}},
             "which normal laws");
  }

  void prepare(const World& world) override {
    require_contact(world, name_);
    PairForce::prepare(world);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    return force(*world.contact_term, world, state.x);
  }
};

// The force that makes held vertices stand still or move as their script says: against everything that
// acts on them, and their own inertia. Vertices that are free at present need none.
class Reaction : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    set_.fields(f);
  }
  Unit unit() const override { return units::force; }
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
    for (int v = 0; v < world.dofs.vertex_count(); ++v)
      vertex(gradient, v) += world.mass(v) * vertex(state.a, v);
    world.dofs.collect(gradient);
    Vec3 sum = Vec3::Zero();
    for (const int v : set_.vertices())
      if (!world.dofs.moves(v)) sum += vertex(gradient, v);
    for (const DofMap::HeldBlock& h : world.dofs.held_blocks()) {
      const int v = world.dofs.vertex_of_block(h.block);
      if (std::binary_search(set_.vertices().begin(), set_.vertices().end(), v)) sum += h.held * vertex(gradient, v);
    }
    return sum;
  }

 private:
  VertexSet set_;
};

TACK_REGISTER(Probe, ContactForce, "contact_force", "Normal contact force between objects [N].", "");
TACK_REGISTER(Probe, Reaction, "reaction", "The force that holds or drives a selection of held vertices [N].", "");

}  // namespace
}  // namespace tack
