// Maxwell branch of rods and of the bending of sheets, which are quadratic in strains
// (strain_spring.hpp): the spring stores 1/2 e^T C e in its elastic strains e = s(x) - r, and its
// rest strains r flow. A step h decays at its start, moves without flow, and decays at its end, as
// in solids (maxwell.hpp),
//     e' = b e_n,   e_tr = s(x) - r',   e_(n+1) = a e_tr,   a = (1 - exp(-x)) / x,   b = exp(-x) /
//     a,
// x = h / time; the potential is a/2 e_tr^T C e_tr. It is exact at a constant rate of strain.
// History variables: r of each strain. Source: Taylor, Pister, Goudreau 1970, Thermomechanical
// analysis of viscoelastic solids.
#pragma once

#include <memory>
#include <string>

#include "energies/viscoelastic/relaxation.hpp"
#include "energies/viscoelastic/shifted_times.hpp"
#include "framework/core/strain_spring.hpp"
#include "framework/core/term.hpp"

namespace tack {

class StrainBranch : public Term {
 public:
  // spring: a StrainSpring. history_name: of its array. time: s, at the reference temperature.
  StrainBranch(std::string name, std::string history_name, std::unique_ptr<Term> spring,
               double time, ShiftedTimes times);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;

  double value(const VecX& x) const override { return factor_ * term_->value(x); }
  std::vector<StencilBatch> batches() const override { return term_->batches(); }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // J

 private:
  double time() const { return time_ * shift_; }  // s

  std::string history_name_;
  std::unique_ptr<Term> term_;
  StrainSpring& spring_;  // the same
  size_t gradient_slots_ = 0, hessian_slots_ = 0;
  double time_;  // s
  ShiftedTimes times_;
  VecX unstrained_;                        // rest strains without flow
  VecX committed_;                         // r after the last step
  VecX first_;                             // e_n
  double shift_ = 1, h_ = 0, factor_ = 1;  // of this step: a_T, s, a
};

}  // namespace tack
