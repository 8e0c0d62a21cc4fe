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

  // Adhesion and the change of its area have the same factor in every integrator (assembly/term_scales.hpp).
  bool dynamic() const override { return true; }

  void forget() override { set_force({}); }
  void begin_step(const StepStart& start) override {
    set_force(system_.rim_forces().all());
    set_reference(start.x);
  }

  bool share_energy(const VecX& x, const EnergyShare& share) const override {
    for (int v = 0; v < force().size() / 3; ++v)
      if (!vertex(force(), v).isZero(0)) share({&v, 1}, -vertex(force(), v).dot(vertex(x, v) - vertex(reference(), v)));
    return true;
  }

  // All of it is adhesion, and the forces those of the step, wherever it is. Its work is within what contact stores.
  void publish(Records& records) const override {
    ForceRecord force_record{"rim", Acting::normal, {"adhesion"}};
    force_record.add = [this](const VecX&, std::string_view, VecX& forces) {
      if (force().size() > 0) forces += force();
    };
    force_record.between = [this](const VecX&, std::string_view, ObjectPair pair) {
      return system_.rim_forces().on(pair.a, pair.b, system_.surface().mesh);
    };
    records.add(std::move(force_record));
    records.add(EnergyRecord{"adhesion", EnergyKind::contact, [this](const VecX& x) { return value(x); }});
    records.add(FlowRecord{"rim", {{"work_rim", FlowKind::within}}, [this](const VecX& x, double* amounts) { amounts[0] = -value(x); }});
  }

 private:
  const ContactSystem& system_;
};

}  // namespace tack
