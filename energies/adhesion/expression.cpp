// A law given as a formula in the scene file. The formula is converted to a curve within 1e-6 of its peak; the energy is the exact integral of the
// curve.
#include "energies/adhesion/curve_adhesion.hpp"
#include "energies/adhesion/traction_formula.hpp"

namespace tack {

class ExpressionAdhesion : public CurveAdhesion<ExpressionAdhesion> {
 public:
  void fields(Fields& f) override {
    formula_.fields(f);
    f.flag("cut", cut_, "the traction may jump to 0 at the range");
  }
  void prepare(const PairMaterials& m) override {
    AdaptiveCurve sampled;
    try {
      sampled = formula_.sample();
    } catch (const InputError& error) {
      throw InputError(std::string("adhesion expression: ") + error.what());
    }
    check_traction(sampled.curve, cut_, m.contact_distance, "adhesion expression");
    error_ = sampled.error, knots_ = sampled.curve.knots();
    set(std::move(sampled.curve));
  }
  std::string note() const override {
    return fmt::format("expression: followed by {} knots to within {:.2g} of its peak", knots_, error_);
  }
  std::vector<std::string> warnings() const override {
    if (error_ <= AdaptiveCurve::tolerance) return {};
    return {fmt::format("expression: {} knots follow it to within {:.2g} of its peak only, {:.0g} is the aim: it is rough somewhere", knots_, error_,
                        AdaptiveCurve::tolerance)};
  }

 private:
  TractionFormula formula_;
  bool cut_ = false;
  int knots_ = 0;
  double error_ = 0;  // relative to the peak
};

TACK_REGISTER(AdhesionLaw, ExpressionAdhesion, "expression", "Traction or energy as a formula of the gap.", "");

}  // namespace tack
