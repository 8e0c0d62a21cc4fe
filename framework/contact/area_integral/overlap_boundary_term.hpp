// Overlap-boundary forces (overlap_boundary_forces.hpp) as a potential that is linear in the
// positions, with constant forces through the step. At the end of a step its value is, to first
// order, the difference between the adhesion energy with the present areas and with those of the
// start of the step. It therefore counts as adhesion.
#pragma once

#include "framework/contact/area_integral/area_integral.hpp"
#include "framework/contact/area_integral/overlap_boundary_forces.hpp"
#include "framework/core/linear_term.hpp"
#include "framework/core/records.hpp"

namespace tack {

class OverlapBoundaryTerm : public LinearTerm {
 public:
  // The integral must outlive this term, and begin each step before it.
  explicit OverlapBoundaryTerm(const AreaIntegral& integral)
      : LinearTerm("rim"), integral_(integral) {}

  // Adhesion and the change of its area have one factor in every integrator (term_scales.hpp).
  bool dynamic() const override { return true; }

  void clear_caches() override { set_force({}); }
  void begin_step(const StepStart& start) override {
    set_force(integral_.overlap_boundary_forces().all());
    set_reference(start.x);
  }

  bool visit_energies(const VecX& x, const EnergyVisitor& visit) const override {
    for (int v = 0; v < force().size() / 3; ++v)
      if (const Vec3 f = vertex(force(), v); !f.isZero(0))
        visit({&v, 1}, -f.dot(vertex(x, v) - vertex(reference(), v)));
    return true;
  }

  // Publishes the forces and the energy as adhesion. The forces do not depend on x within a step.
  // Their work is part of the energy that contact stores.
  void publish(Records& records) const override {
    ForceRecord force_record{"rim", ForceDirection::normal, {"adhesion"}};
    force_record.add = [this](const VecX&, std::string_view, VecX& forces) {
      if (force().size() > 0) forces += force();
    };
    force_record.between = [this](const VecX&, std::string_view, ObjectPair pair) {
      return integral_.overlap_boundary_forces().on(pair.a, pair.b, integral_.mesh());
    };
    records.add(std::move(force_record));
    records.add(
        EnergyRecord{"adhesion", EnergyKind::contact, [this](const VecX& x) { return value(x); }});
    records.add(FlowRecord{"rim",
                           {{"work_rim", FlowKind::within}},
                           [this](const VecX& x, double* amounts) { amounts[0] = -value(x); }});
  }

 private:
  const AreaIntegral& integral_;
};

}  // namespace tack
