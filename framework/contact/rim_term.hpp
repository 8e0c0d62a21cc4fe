// The forces by which covered areas change (rim_forces.hpp), held through the step: a potential linear in the positions. At the
// end of a step it says, to first order, by how much the energy of adhesion differs from what it is with the areas of
// the start; so it belongs to that energy.
#pragma once

#include "framework/contact/contact_term.hpp"
#include "framework/contact/rim_forces.hpp"
#include "framework/core/linear_term.hpp"

namespace tack {

class RimTerm : public LinearTerm {
 public:
  // The system must outlive it, and be told of steps before it.
  explicit RimTerm(const ContactSystem& system) : LinearTerm("rim"), system_(system) {}

  void forget() override { set_force({}); }
  void begin_step(const StepStart& start) override {
    set_force(system_.rim_forces().all());
    set_reference(start.x);
  }

  // All of it is adhesion; the arguments are those of ContactTerm, and the forces those of the step, wherever it is.
  VecX forces(const VecX& x, LawPart part) const {
    return part == LawPart::barrier || force().size() == 0 ? VecX::Zero(x.size()) : force();
  }
  Vec3 force_between(const VecX&, LawPart part, ObjectPair pair) const {
    return part == LawPart::barrier ? Vec3::Zero() : system_.rim_forces().on(pair.a, pair.b, system_.surface().mesh);
  }

 private:
  const ContactSystem& system_;
};

}  // namespace tack
