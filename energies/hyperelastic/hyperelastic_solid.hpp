// Solids with psi = W(e) + K/2 (ln J)^2, W a law in logarithmic isochoric stretches
// (isochoric.hpp). With P = 1 - 1/3 the projection to the deviator, Kirchhoff's stress and its
// derivative by ln s are
//     tau = P W' + K ln J,   H = P W'' P + K.
// A law has
//   Pack energy(const PackVec3& e) const;                       W [J/m^3], may be infinite
//   IsochoricDerivatives derivatives(const PackVec3& e) const;  where W is finite
//   double shear() const;                                       small-strain shear modulus [Pa]
// and, if W is infinite beyond a limit, limit_names and limit_use(e) (solid/limited_term.hpp).
// Sources: Holzapfel 2000, Nonlinear Solid Mechanics, sections 6.4 and 6.5.
#pragma once

#include <algorithm>

#include "energies/hyperelastic/isochoric.hpp"
#include "energies/solid/composite_term.hpp"
#include "energies/solid/isotropic_solid.hpp"
#include "energies/solid/limited_term.hpp"
#include "energies/solid/patch_term.hpp"
#include "framework/config/field.hpp"

namespace tack {

/// A law whose energy is infinite beyond a limit.
template <class Law>
concept LimitedLaw = requires(const Law& law, const Vec3& e) {
  law.limit_use(e);
};

/// Returns the names of the limit of a law, or none.
template <class Law>
constexpr LimitNames names_of_limit() {
  if constexpr (LimitedLaw<Law>) return Law::limit_names;
  else return {};
}

/// Makes the term of linear elements of a law, which names its limit if it has one.
template <class Base, class Element, class Law, class... Arguments>
std::unique_ptr<Term> make_law_term(const Arguments&... arguments) {
  if constexpr (LimitedLaw<Law>) return std::make_unique<LimitedTerm<Base, Element>>(arguments...);
  else return std::make_unique<Base>(arguments...);
}

/// Material of an isochoric law and a bulk modulus.
template <class Law>
struct Hyperelastic {
  Law law;
  double bulk;  // K [Pa]

  Pack energy(const PackMat3& f) const {
    PackVec3 e;
    const Pack log_j = split_strain(svd3(f).s, e);
    return select(f.determinant() > 0, law.energy(e) + bulk / 2 * log_j * log_j, infinity);
  }

  PrincipalDerivatives derivatives(const PackVec3& s) const {
    PackVec3 e, tau;
    const Pack pressure = bulk * split_strain(s, e);
    const IsochoricDerivatives w = law.derivatives(e);
    const PackVec3 rows = w.hessian.rowwise().sum() / Pack(3);
    const Pack mean = w.gradient.sum() / 3, corner = bulk + rows.sum() / 3;
    PackMat3 h;
    for (int i = 0; i < 3; ++i) {
      tau(i) = w.gradient(i) - mean + pressure;
      for (int k = 0; k < 3; ++k) h(i, k) = w.hessian(i, k) - rows(i) - rows(k) + corner;
    }
    return of_logarithms(s, tau, h, 0);
  }

  // Points and parts keep the bulk modulus of a solid with lambda = 0, as other elastic solids do.
  // It keeps parts from inverting.
  auto split() const {
    const double kept = std::min(bulk, 2 * law.shear() / 3);
    const Hyperelastic shape{law, kept};
    return MaterialSplit<Hyperelastic, Hyperelastic, LogVolume>{shape, shape, {bulk - kept}};
  }

  static constexpr LimitNames limit_names = names_of_limit<Law>();
  LimitUse limit_use(std::span<const double> stretches) const requires LimitedLaw<Law> {
    const Vec3 e = Eigen::Map<const Vec3>(stretches.data()).array().log();
    return law.limit_use(e.array() - e.mean());
  }

 private:
  // Sets e to the logarithmic isochoric stretches; returns ln J.
  static Pack split_strain(const PackVec3& s, PackVec3& e) {
    for (int i = 0; i < 3; ++i) e(i) = log(s(i));
    const Pack trace = e.sum();
    for (int i = 0; i < 3; ++i) e(i) -= trace / 3;
    return trace;
  }
};

/// Base of energies of hyperelastic solids. Law: default-constructible, with the functions above,
/// and fields() of its parameters.
template <class Law>
class HyperelasticSolid : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    law_.fields(f);
    f.number(
         "poisson", poisson_, units::none,
         "Poisson's ratio of small strains: K = 2 mu (1 + nu) / (3 (1 - 2 nu)), with mu the shear "
         "modulus of small strains")
        .range(-0.99, 0.4999);
    f.number("density", density_, units::density, "mass per rest volume").positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    using Material = Hyperelastic<Law>;
    const std::string name(type());
    const Material material{law_, 2 * law_.shear() * (1 + poisson_) / (3 * (1 - 2 * poisson_))};
    if (body.elements == Elements::linear)
      return make_law_term<SolidTerm<Material>, Tet, Law>(name, material, body, rest);
    if (body.elements == Elements::composite)
      return std::make_unique<CompositeTerm<Material>>(name, material, body, rest);
    const auto split = material.split();
    return std::make_unique<PatchTerm<Material, LogVolume>>(name, split.shape, split.volume, body,
                                                            rest);
  }
  bool takes_elements() const override { return true; }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override {
    add_tet_mass(body, rest, density_, mass);
  }
  std::optional<double> young() const override { return 2 * law_.shear() * (1 + poisson_); }
  std::optional<double> poisson() const override { return poisson_; }
  std::optional<double> shear() const override { return law_.shear(); }

 private:
  Law law_;
  double poisson_ = 0.49;
  double density_ = 1000;  // kg/m^3
};

}  // namespace tack
