// Plastic flow of composite tets. Every sample (composite_samples.hpp), parts included, has its own
// flow, so that homogeneous flow equals that of a linear tet.
#pragma once

#include "energies/solid/composite_term.hpp"
#include "energies/plasticity/plastic_history.hpp"

namespace tack {

class CompositeVonMises : public CompositeTerm<VonMises> {
 public:
  CompositeVonMises(std::string name, const VonMises& material, const Body& body, const VecX& rest);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override { set_step(start.h); }
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // plastic work of a step to x [J]
  double viscous(const VecX& x) const;     // viscous dissipation beside it [J]

 private:
  void set_step(double h) { material_.h = split_.shape.h = split_.part.h = h; }  // s
  // Returns the strains of the parts, as for stresses.
  VecX plastic_strain() const;

  VonMises material_;
  PlasticHistory history_;
};

}  // namespace tack
