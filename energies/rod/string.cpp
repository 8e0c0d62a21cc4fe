// Strings: edges that stretch, without bending or twisting stiffness.
#include "energies/rod/edge_stretching.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"

namespace tack {
namespace {

class StringTerm : public Term, public ResidualView {
 public:
  StringTerm(std::string name, double stretching, const Body& body, const VecX& rest)
      : Term(std::move(name)), stretching_(body.edges, stretching, rest) {}

  double value(const VecX& x) const override { return stretching_.value(x); }
  std::vector<StencilBatch> batches() const override { return {stretching_.batch()}; }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    stretching_.derivatives(x, projection, gradient, hessian);
  }

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override { return {stretching_.residual_batch()}; }
  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    stretching_.residuals(x, r, jacobian);
    return true;
  }

 private:
  EdgeStretching stretching_;
};

class String : public Energy {
 public:
  void fields(Fields& f) override {
    Energy::fields(f);
    f.number("young", young_, units::pressure, "Young's modulus E").required().positive();
    f.number("density", density_, units::density, "mass per rest volume").positive();
  }
  std::unique_ptr<Term> make_term(const Body& body, const VecX& rest) const override {
    return std::make_unique<StringTerm>(std::string(type()), young_ * section_of(body, type()).area(), body, rest);
  }
  void add_mass(const Body& body, const VecX& rest, VecX& mass) const override { add_edge_mass(body, rest, density_, mass); }
  std::optional<double> young() const override { return young_; }

 private:
  double young_ = 1e9;     // Pa
  double density_ = 1000;  // kg/m^3
};

TACK_REGISTER(Energy, String, "string", "Edges with a section (`rod`) that stretch but neither bend nor twist.", "");

}  // namespace
}  // namespace tack
