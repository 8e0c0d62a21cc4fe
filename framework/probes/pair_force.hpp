// The force that one object exerts on another, or all on one, through a part of the laws of a term that
// has forces(x, part) and force_between(x, part, pair).
#pragma once

#include "framework/output/probe.hpp"
#include "framework/probes/vertex_set.hpp"
#include "framework/scene/world.hpp"

namespace tack {

template <class Part>
class PairForce : public VectorProbe {
 public:
  void fields(Fields& f) override {
    VectorProbe::fields(f);
    f.text("on", on_, "the object that the force acts on").required();
    f.text("from", from_, "the object that exerts it; without it, all others together");
  }
  Unit unit() const override { return units::force; }
  void prepare(const World& world) override {
    a_ = object_index(world, on_, name_);
    b_ = from_.empty() ? -1 : object_index(world, from_, name_);
  }

 protected:
  template <class ForceTerm>
  Vec3 force(const ForceTerm& term, const World& world, const VecX& x) const {
    if (b_ >= 0) return term.force_between(x, part_, {a_, b_});
    const VecX forces = term.forces(x, part_);
    Vec3 sum = Vec3::Zero();
    for (const int v : world.vertices_of(a_)) sum += vertex(forces, v);
    return sum;
  }

  Part part_ = Part::all;

 private:
  std::string on_, from_;
  int a_ = -1, b_ = -1;
};

}  // namespace tack
