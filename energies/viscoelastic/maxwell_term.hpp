// Terms of a Maxwell branch: of linear tets, of tets with patches, and of composite tets.
#pragma once

#include "energies/solid/composite_term.hpp"
#include "energies/solid/solid_term.hpp"
#include "energies/solid/svd3.hpp"
#include "energies/viscoelastic/maxwell.hpp"
#include "energies/viscoelastic/viscous_history.hpp"

namespace tack {

// Returns the part of the Hencky strain of an elastic deformation gradient that decays.
inline Relaxation<3>::Strain decaying_strain(const Relaxation<3>& relaxation, const Mat3& elastic) {
  const Svd3<double> svd = svd3(elastic);
  return relaxation.strain(svd.v, svd.s);
}

// Publishes the dissipation of a step to x.
void publish_relaxation(Records& records, const std::string& term,
                        std::function<double(const VecX& x)> dissipated);

class MaxwellTets : public SolidTerm<Maxwell> {
 public:
  MaxwellTets(std::string name, const MaxwellParameters& parameters, const Body& body,
              const VecX& rest);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // J

 protected:
  StressRecord stress_record() const override;

 private:
  void apply_history();
  Relaxation<3>::Strain strain(int t, const VecX& x) const {
    return decaying_strain(history_.relaxation(), deformation(t, x));
  }

  MaxwellParameters parameters_;
  ViscousHistory<3> history_;
  std::vector<TetRest<Pack>> rest_shapes_;  // without viscous flow; rest_ includes it
};

class CompositeMaxwell : public CompositeTerm<Maxwell> {
 public:
  CompositeMaxwell(std::string name, const MaxwellParameters& parameters, const Body& body,
                   const VecX& rest);

  void load_history(const History& history) override;
  void begin_step(const StepStart& start) override;
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // J

 private:
  void apply_history();
  Relaxation<3>::Strain strain(int sample, const VecX& x) const {
    return decaying_strain(history_.relaxation(), tets_.deformation(sample / composite_samples,
                                                                    sample % composite_samples, x));
  }
  double volume_of(int sample) const {
    return tets_.weight(sample % composite_samples) * tets_.volume_of(sample / composite_samples);
  }

  MaxwellParameters parameters_;
  ViscousHistory<3> history_;
};

}  // namespace tack
