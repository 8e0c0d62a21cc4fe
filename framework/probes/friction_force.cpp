// Probe of the forces along touching surfaces.
#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/scene/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// The tangential force of the last step that the second object exerts on the first, or all on one.
class FrictionForce : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    f.text("on", on_, "the object that the force acts on").required();
    f.text("from", from_, "the object that exerts it; without it, all others together");
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
    a_ = object_index(world, on_, name_);
    b_ = from_.empty() ? -1 : object_index(world, from_, name_);
  }

 protected:
  Vec3 value(const World& world, const State& state) override {
    if (b_ >= 0) return world.friction->force_between(state.x, part_, {a_, b_});
    const VecX forces = world.friction->forces(state.x, part_);
    Vec3 sum = Vec3::Zero();
    const Body& body = world.bodies[a_];
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
      sum += vertex(forces, v);
    return sum;
  }

 private:
  std::string on_, from_;
  TangentialPart part_ = TangentialPart::all;
  int a_ = -1, b_ = -1;
};

TACK_REGISTER(Probe, FrictionForce, "friction_force",
              "Friction and tangential adhesion between objects in the last step [N].", "");

}  // namespace
}  // namespace tack
