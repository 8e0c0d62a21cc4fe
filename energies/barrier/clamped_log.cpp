// The clamped logarithmic barrier of IPC, with its stiffness in pascals; dhat is the contact distance.
//   plain:   b(d) = -kappa dhat (d/dhat - 1)^2 ln(d/dhat),        0 < d < dhat   (the paper, eq. 2)
//   squared: that formula in s = d^2, with dhat^2 for dhat and a stiffness with which the force at
//            d = dhat/2 equals that of the plain form.
#include "framework/config/field.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class ClampedLogBarrier : public NormalLawOf<ClampedLogBarrier, BarrierLaw> {
 public:
  enum class Form { plain, squared };

  void fields(Fields& f) override {
    f.choice("form", form_, {{"plain", Form::plain, "logarithm of the gap"},
                             {"squared", Form::squared, "logarithm of the squared gap"}},
             "the argument of the barrier");
    f.optional_number("stiffness", stiffness_, units::pressure,
                      "kappa. Unless given, a tenth of the softer Young's modulus; for an affine body a hundredth of "
                      "its stiffness; for a soft body that may fly or fall faster than its wave speed, density times "
                      "that speed squared, up to ten times the modulus; for a sheet on which only weight and contact "
                      "act, at most a thousand times the pressure on it (weight of all that moves, its own mass "
                      "stopped within a step, its tension). At most a twentieth of the pair's peak adhesive "
                      "traction, but at least the pressure of weight and loads minus ten peak tractions")
        .positive();
  }

  void prepare(const PairMaterials& m) override {
    contact_distance_ = m.contact_distance;
    if (!stiffness_) stiffness_ = default_stiffness(m);
    kappa_ = *stiffness_;
    if (form_ == Form::plain) return;
    // plain: b'(dhat/2) = -kappa g(1/2); squared: -kappa_s 2 d g(1/4), g(r) = 2 (r-1) ln r + (r-1)^2 / r
    const auto g = [](double r) { return 2 * (r - 1) * std::log(r) + (r - 1) * (r - 1) / r; };
    kappa_ *= g(0.5) / (contact_distance_ * g(0.25));
  }

  double range() const override { return contact_distance_; }

  template <class T>
  T energy(const T& d) const {
    using std::log;
    if (form_ == Form::plain) {
      const T r = d / T(contact_distance_);
      return T(-kappa_ * contact_distance_) * (r - T(1)) * (r - T(1)) * log(r);
    }
    const T r = d * d / T(contact_distance_ * contact_distance_);
    return T(-kappa_ * contact_distance_ * contact_distance_) * (r - T(1)) * (r - T(1)) * log(r);
  }

 private:
  static double default_stiffness(const PairMaterials& m) {
    constexpr double of_young = 0.1, of_adhesion = 0.05, without_material = 1e5;
    const double modulus = m.softer_stiffness > 0 ? m.softer_stiffness : m.softer_young;
    double kappa = modulus > 0 ? of_young * modulus : without_material;
    if (m.adhesion_peak > 0) kappa = std::min(kappa, of_adhesion * m.adhesion_peak);
    return kappa;
  }

  Form form_ = Form::plain;
  std::optional<double> stiffness_;
  double contact_distance_ = 1e-3;  // m
  double kappa_ = 1e5;              // Pa; for the squared form Pa/m
};

TACK_REGISTER(BarrierLaw, ClampedLogBarrier, "clamped_log",
              "Clamped logarithmic barrier; twice differentiable where it ends.",
              "Li et al. 2020, Incremental Potential Contact; Fang et al., eq. 2");

}  // namespace tack
