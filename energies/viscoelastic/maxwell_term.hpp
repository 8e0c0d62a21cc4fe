// Terms of a Maxwell branch: of linear tets, of tets with patches, and of composite tets.
#pragma once

#include "energies/solid/composite_term.hpp"
#include "energies/solid/solid_term.hpp"
#include "energies/solid/svd3.hpp"
#include "energies/viscoelastic/maxwell.hpp"
#include "energies/viscoelastic/relaxing_term.hpp"

namespace tack {

// Returns the part of the Hencky strain of an elastic deformation gradient that decays.
inline Relaxation<3>::Strain decaying_strain(const Relaxation<3>& relaxation, const Mat3& elastic) {
  const Svd3<double> svd = svd3(elastic);
  return relaxation.strain(svd.v, svd.s);
}

class MaxwellTets : public RelaxingTerm<MaxwellTets, SolidTerm<Maxwell>, 3> {
 public:
  MaxwellTets(std::string name, const MaxwellParameters& parameters, const Body& body,
              const VecX& rest);

 protected:
  StressRecord stress_record() const override {
    return StressRecord{[this](const VecX& x) { return per_deformed_volume(cauchy_stress(x)); }};
  }

 private:
  friend RelaxingTerm;
  void apply_history();
  int samples() const { return count(); }
  Strain strain(int t, const VecX& x) const {
    return decaying_strain(history_.relaxation(), deformation(t, x));
  }
  double volume_of(int t) const { return rest_shapes_[t / pack_width].volume[t % pack_width]; }

  MaxwellParameters parameters_;
  std::vector<TetRest<Pack>> rest_shapes_;  // without viscous flow; rest_ includes it
};

class CompositeMaxwell : public RelaxingTerm<CompositeMaxwell, CompositeTerm<Maxwell>, 3> {
 public:
  CompositeMaxwell(std::string name, const MaxwellParameters& parameters, const Body& body,
                   const VecX& rest);

 protected:
  std::vector<Mat3> cauchy_stress(const VecX& x) const override;

 private:
  friend RelaxingTerm;
  void apply_history();
  int samples() const { return composite_samples * count(); }
  Strain strain(int i, const VecX& x) const {
    return decaying_strain(history_.relaxation(), tets_.deformation(i, x));
  }
  double volume_of(int i) const { return tets_.volume_of_sample(i); }

  MaxwellParameters parameters_;
};

}  // namespace tack
