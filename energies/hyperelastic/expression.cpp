// The energies `expression` and `expression_membrane`: materials whose density is a formula of the scene.
#include <fmt/format.h>

#include "energies/hyperelastic/expression_material.hpp"
#include "energies/shell/membrane_term.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// An incompressible sheet in plane stress: psi(s1, s2, 1 / (s1 s2)).
struct ExpressionSheet {
  EnergyFormula formula;

  Pack energy(const PlaneStrain&, const PackMat32& f) const {
    const PackVec2 s = plane_stretch(f).s;
    using Jet = PackJet<Pack, 1>;
    Jet a, b;
    a.v = s(0), b.v = s(1);
    const Pack psi = formula(std::array<Jet, 3>{a, b, Jet(1.0) / (a * b)}).v;
    return select((s.prod() > 0) & (psi < infinity), psi, infinity);
  }
  PlaneDerivatives derivatives(const PackVec2& s) const {
    using Jet = PackJet<Pack, 2>;
    const Jet a = Jet::variable(s(0), 0), b = Jet::variable(s(1), 1), psi = formula(std::array<Jet, 3>{a, b, Jet(1.0) / (a * b)});
    PlaneDerivatives d;
    for (int i = 0; i < 2; ++i) d.gradient(i) = psi.d[i];
    d.hessian(0, 0) = psi.h[0];
    d.hessian(0, 1) = d.hessian(1, 0) = psi.h[1];
    d.hessian(1, 1) = psi.h[2];
    return d;
  }
};

// Formulas of a material and what they are at small strains.
struct ExpressionFields {
  std::string energy = "1e5 * (I1_bar - 3) + 1e5 * ln(J)^2", volume;  // J/m^3
  std::map<std::string, Quantity> parameters;
  double density = 1000;  // kg/m^3

  void energy_field(Fields& f, const char* doc) { f.text("energy", energy, doc).required().formula(EnergyFormula::variables()); }
  void other_fields(Fields& f) {
    f.quantities("parameters", parameters, "parameters of the formulas with values in any unit: `{mu: 0.3 MPa}`; formulas have them in SI");
    f.number("density", density, units::density, "mass per rest volume").positive();
  }
  EnergyFormula formula() const { return {energy, parameters}; }
  EnergyFormula volume_formula() const { return {volume, parameters, true}; }
  // Throws InputError at a parameter that neither formula has.
  void check_parameters() const {
    const EnergyFormula w = formula(), u = volume_formula();
    for (const auto& [name, quantity] : parameters)
      if (!w.uses(name) && !u.uses(name)) throw InputError(fmt::format("the parameter '{}' does not occur in a formula; take it out, or mend one of them", name));
  }
};

using RestJet = PackJet<double, 3>;
std::array<RestJet, 3> rest_stretches() { return {RestJet::variable(1, 0), RestJet::variable(1, 1), RestJet::variable(1, 2)}; }

// Lame parameters of a density that is isotropic: of its Hessian in stretches at rest.
Lame lame_of(const RestJet& psi) { return {(psi.h[0] - psi.h[1]) / 2, psi.h[1]}; }

class ExpressionSolid : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    fields_.energy_field(f, "density [J/m^3]: a formula of I1, I2, J, of I1_bar = J^(-2/3) I1 and I2_bar = J^(-4/3) I2, or of the stretches s1, s2, s3, and of parameters");
    f.text("volume", fields_.volume, "density that is added, a formula of J: composite tets and patches take their mean J for it, so that it does not lock").formula({"J"});
    fields_.other_fields(f);
    f.check("energy", [this] { return error(); });
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    const std::string name(type());
    const ExpressionMaterial m = material();
    if (body.elements == Elements::linear) return std::make_unique<SolidTerm<ExpressionMaterial>>(name, m, body, rest);
    if (body.elements == Elements::composite) return std::make_unique<CompositeTerm<ExpressionMaterial>>(name, m, body, rest);
    const auto split = m.split();
    return std::make_unique<PatchTerm<ExpressionMaterial, ExpressionVolume>>(name, split.shape, split.volume, body, rest);
  }
  bool takes_elements() const override { return true; }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override { add_tet_mass(body, rest, fields_.density, mass); }
  std::optional<double> young() const override {
    const Lame l = material().lame;
    return l.mu * (3 * l.lambda + 2 * l.mu) / (l.lambda + l.mu);
  }
  std::optional<double> poisson() const override {
    const Lame l = material().lame;
    return l.lambda / (2 * (l.lambda + l.mu));
  }
  std::optional<double> shear() const override { return material().lame.mu; }

 private:
  ExpressionMaterial material() const {
    ExpressionMaterial m{fields_.formula(), fields_.volume_formula()};
    const Lame w = lame_of(m.energy_formula(rest_stretches())), u = lame_of(m.volume_formula(rest_stretches()));
    m.volume_bulk = u.lambda + 2 * u.mu / 3;
    m.lame = {w.mu + u.mu, w.lambda + u.lambda};
    return m;
  }
  std::string error() const {
    try {
      fields_.check_parameters();
      const RestJet w = fields_.formula()(rest_stretches()), u = fields_.volume_formula()(rest_stretches());
      const Lame l = lame_of(w + u);
      const double bulk = l.lambda + 2 * l.mu / 3;
      constexpr double round_off = 1e-9;
      if (!(l.mu > 0)) return fmt::format("'{}' has the shear modulus {:.4g} Pa at small strains, which must be positive", fields_.energy, l.mu);
      for (const auto& [psi, text] : {std::pair(w, fields_.energy), {u, fields_.volume}})
        if (!(std::abs(psi.d[0]) <= round_off * (std::abs(l.lambda) + l.mu)))
          return fmt::format("'{}' has a stress of {:.6g} Pa at rest; add a term of J that balances it, such as {:.6g} * ln(J)", text, psi.d[0], -psi.d[0]);
      if (!(bulk > round_off * l.mu)) return fmt::format("the material has the bulk modulus {:.4g} Pa at small strains; give `volume`, such as K / 2 * ln(J)^2", bulk);
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  }

  ExpressionFields fields_;
};

class ExpressionMembrane : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    fields_.energy_field(f, "density [J/m^3]: a formula of I1 and I2, or of the stretches s1, s2, s3, and of parameters; J = 1, and s3 is 1 / (s1 s2)");
    fields_.other_fields(f);
    f.check("energy", [this] { return error(); });
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    require_sheet(body, rest, type());
    return std::make_unique<MembraneTerm<ExpressionSheet>>(std::string(type()), ExpressionSheet{fields_.formula()}, body, rest);
  }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override { add_sheet_mass(body, rest, fields_.density, mass); }
  std::optional<double> young() const override { return 3 * *shear(); }
  // In pure shear the energy of the stretches s and 1 / s is 2 mu (ln s)^2.
  std::optional<double> shear() const override { return shear_of(fields_.formula()); }

 private:
  static double shear_of(const EnergyFormula& formula) {
    using Jet = PackJet<double, 1>;
    const Jet s = Jet::variable(1, 0);
    return formula(std::array<Jet, 3>{s, Jet(1.0) / s, Jet(1.0)}).h[0] / 4;
  }
  std::string error() const {
    try {
      fields_.check_parameters();
      const double mu = shear_of(fields_.formula());
      return mu > 0 ? "" : fmt::format("'{}' has the shear modulus {:.4g} Pa at small strains, which must be positive", fields_.energy, mu);
    } catch (const InputError& error) {
      return error.what();
    }
  }

  ExpressionFields fields_;
};

TACK_REGISTER(Energy, ExpressionSolid, "expression", "Solid whose energy is a formula of invariants or principal stretches.",
              "Holzapfel 2000, Nonlinear Solid Mechanics, sections 6.2 and 6.4");
TACK_REGISTER(Energy, ExpressionMembrane, "expression_membrane", "Incompressible membrane whose energy is a formula of invariants or principal stretches.",
              "Holzapfel 2000, Nonlinear Solid Mechanics, section 6.5");

}  // namespace
}  // namespace tack
