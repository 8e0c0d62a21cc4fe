// Probe of the forces along touching surfaces.
#include "framework/contact/friction_term.hpp"
#include "framework/output/probe.hpp"
#include "framework/probes/pair_force.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The tangential force of the last step that the second object exerts on the first, or all on one.
class FrictionForce : public PairForce<TangentialPart> {
 public:
  void fields(Fields& f) override {
    PairForce::fields(f);
    f.choice("part", part_,
             {{"all", TangentialPart::all, "friction and tangential adhesion"},
              {"friction", TangentialPart::friction, "friction only"},
              {"adhesion", TangentialPart::adhesion, "tangential adhesion only"}},
             "which tangential laws");
  }

  void prepare(const World& world) override {
    if (!world.friction)
      throw InputError("probe '" + name_ + "': no pair has friction or tangential adhesion; give one "
                       "in contact.pairs");
    PairForce::prepare(world);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    return force(*world.friction, world, state.x);
  }
};

TACK_REGISTER(Probe, FrictionForce, "friction_force",
              "Friction and tangential adhesion between objects in the last step [N].", "");

}  // namespace
}  // namespace tack
