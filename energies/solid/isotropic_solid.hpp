// Base of all isotropic solid energies: parameters, lumped mass and the term. An elastic material
// is its density and derivatives, optionally with a split (material_split.hpp), and a TACK_REGISTER
// of IsotropicSolid<Material>.
#pragma once

#include <limits>

#include "energies/solid/least_squares_solid.hpp"
#include "energies/solid/material_split.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"

namespace tack {

/// The energy of an inverted tet.
inline constexpr double infinity = std::numeric_limits<double>::infinity();

/// Lame parameters [Pa].
struct Lame {
  double mu = 0, lambda = 0;
};
/// Returns the Lame constants [Pa]. young: Pa.
inline Lame lame(double young, double poisson) {
  return {young / (2 * (1 + poisson)), young * poisson / ((1 + poisson) * (1 - 2 * poisson))};
}

/// Adds a quarter of each tet's mass to its vertices [kg].
void add_tet_mass(const Body& body, const VecX& rest, double density, VecX& mass);

/// Base of energies of solids: elements, damping and mass.
class SolidEnergy : public Energy {
 public:
  void fields(Fields& f) override;
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override {
    add_tet_mass(body, rest, density_, mass);
  }
  std::optional<double> young() const override { return young_; }
  std::optional<double> poisson() const override { return poisson_; }
  std::optional<double> shear() const override { return lame().mu; }

 protected:
  Lame lame() const { return tack::lame(young_, poisson_); }

 private:
  double young_ = 1e5;  // Pa
  double poisson_ = 0.3;
  double density_ = 1000;  // kg/m^3
};

/// Makes the term of grouped tets (Body::elements). Defined in grouped_solid.hpp. A separate file,
/// or the material of a plugin, includes that header: beside linear tets, the compiler would inline
/// other functions, and linear tets would round differently.
template <SplitMaterial Material>
std::unique_ptr<Term> make_grouped_solid(const std::string& name, const Material& material,
                                         const Body& body, const VecX& rest);

/// Base of energies of isotropic solids; `Material` is the material.
template <class Material>
class IsotropicSolid : public SolidEnergy {
 public:
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    const std::string name(type());
    const Material material{lame()};
    if constexpr (SplitMaterial<Material>)
      if (body.elements != Elements::linear) return make_grouped_solid(name, material, body, rest);
    return std::make_unique<LeastSquaresSolid<Material>>(name, material, body, rest);
  }
  bool takes_elements() const override { return SplitMaterial<Material>; }
};

}  // namespace tack
