// Strings: edges that stretch, without bending or twisting stiffness.
#include "energies/rod/edge_stretching.hpp"
#include "framework/config/field.hpp"
#include "framework/core/strain_spring.hpp"
#include "framework/scene/energy.hpp"
#include "framework/scene/strain_energy.hpp"

namespace tack {
namespace {

class StringTerm : public Term, public ResidualView, public StrainSpring {
 public:
  StringTerm(std::string name, double stretching, const Body& body, const VecX& rest)
      : Term(std::move(name)), stretching_(body.edges, stretching, rest) {}

  double value(const VecX& x) const override { return stretching_.value(x); }
  std::vector<StencilBatch> batches() const override { return {stretching_.batch()}; }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    stretching_.derivatives(x, projection, gradient, hessian);
  }

  // The lengths of the edges.
  VecX spring_strains(const VecX& x) const override {
    VecX lengths(stretching_.count());
    stretching_.lengths(x, lengths.data());
    return lengths;
  }
  VecX rest_strains() const override {
    VecX lengths(stretching_.count());
    stretching_.rest_lengths(lengths.data());
    return lengths;
  }
  void set_rest_strains(const VecX& rest) override { stretching_.set_rest_lengths(rest.data()); }
  double energy_of(const VecX& strains) const override { return stretching_.energy_of(strains.data()); }

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {stretching_.residual_batch()}; }
  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    stretching_.residuals(x, r, jacobian);
    return true;
  }

 private:
  EdgeStretching stretching_;
};

class String : public Energy, public StrainEnergy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("young", young_, units::pressure, "Young's modulus E").required().positive();
    f.number("density", density_, units::density, "mass per rest volume").positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override { return make_scaled(body, rest, 1); }
  std::unique_ptr<Term> make_scaled(const Body& body, const VecX& rest, double scale) const override {
    return std::make_unique<StringTerm>(std::string(type()), scale * young_ * section_of(body, type()).area(), body, rest);
  }
  std::string_view branch() const override { return "maxwell_rod"; }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override { add_edge_mass(body, rest, density_, mass); }
  std::optional<double> young() const override { return young_; }

 private:
  double young_ = 1e9;     // Pa
  double density_ = 1000;  // kg/m^3
};

TACK_REGISTER(Energy, String, "string", "Edges with a section (`rod`) that stretch but neither bend nor twist.", "");

}  // namespace
}  // namespace tack
