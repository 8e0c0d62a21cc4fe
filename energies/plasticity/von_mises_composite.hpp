// Plastic flow of composite tets: every sample (composite_samples.hpp) has its own, parts included, so that a homogeneous flow is that of a linear tet.
#pragma once

#include "energies/solid/composite_term.hpp"
#include "energies/plasticity/plastic_memory.hpp"

namespace tack {

class CompositeVonMises : public CompositeTerm<VonMises> {
 public:
  CompositeVonMises(std::string name, const VonMises& material, const Body& body, const VecX& rest);

  void remember(const History& history) override;
  void begin_step(const StepStart& start) override { set_step(start.h); }
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // plastic work of a step to x [J]
  double viscous(const VecX& x) const;     // what viscosity takes beside it [J]

 private:
  void set_step(double h) { material_.h = split_.shape.h = split_.part.h = h; }  // s
  double volume_of(int sample) const;  // m^3
  // Per sample, as stresses are.
  VecX plastic_strain() const;

  VonMises material_;
  PlasticMemory memory_;
};

}  // namespace tack
