// Base of all membranes: parameters, lumped mass, fibres and the term. An elastic material is one
// file: its density, its derivatives, and a TACK_REGISTER of Membrane<Material>.
#pragma once

#include <limits>

#include "energies/shell/membrane_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"

namespace tack {

// Plane stress: no stress across the sheet, whatever its thickness becomes.
struct PlaneStress {
  double mu = 0;      // of shear [Pa]
  double lambda = 0;  // of the trace of the strain in the plane, E nu / (1 - nu^2) [Pa]
};
inline PlaneStress plane_stress(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young * poisson / (1 - poisson * poisson)};
}

struct FibreConfig {
  Vec3 direction = Vec3::UnitX();
  double young = 0;  // Pa
  void fields(Fields& f);
};

class MembraneEnergy : public Energy {
 public:
  void fields(Fields& f) override;
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override {
    add_sheet_mass(body, rest, density_, mass);
  }
  std::optional<double> young() const override { return young_; }
  std::optional<double> shear() const override { return plane_stress(young_, poisson_).mu; }

 protected:
  // Checks the body first.
  Fibres fibres(const Body& body, const VecX& rest) const;
  double young_ = 1e5;  // Pa
  double poisson_ = 0.3;
  double density_ = 1000;  // kg/m^3

 private:
  std::optional<FibreConfig> fibre_;
};

// A material is made of Young's modulus and Poisson's ratio.
template <class Material>
class Membrane : public MembraneEnergy {
 public:
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    Fibres along = fibres(body, rest);
    return std::make_unique<MembraneTerm<Material>>(std::string(type()), Material(young_, poisson_),
                                                    body, rest, std::move(along));
  }
};

}  // namespace tack
