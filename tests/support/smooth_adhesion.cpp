// Adhesion that is smooth everywhere: phi(d) = -W (1 - d^2/r^2)^3 up to the range r, 0 beyond, where
// value, slope and curvature vanish. The traction peaks at d = r / sqrt(5) with 96 W / (25 sqrt(5) r).
#include <cmath>

#include "framework/config/field.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class SmoothAdhesion : public NormalLawOf<SmoothAdhesion, AdhesionLaw> {
 public:
  void fields(Fields& f) override {
    f.number("strength", strength_, units::pressure, "largest traction").positive();
    f.optional_number("range", given_range_, units::length,
                      "r: three contact distances unless given").positive();
  }
  void prepare(const PairMaterials& m) override {
    range_ = given_range_.value_or(3 * m.contact_distance);
    if (range_ < std::sqrt(5.0) * m.contact_distance)
      throw InputError("adhesion smooth: the traction would peak where the barrier pushes; raise range "
                       "above 2.24 contact distances");
  }
  double range() const override { return range_; }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return strength_ * range_ * 25 * std::sqrt(5.0) / 96; }
  template <class T>
  T energy(const T& d) const {
    const T u = T(1) - d * d / T(range_ * range_);
    return T(-work_of_adhesion()) * u * u * u;
  }

 private:
  double strength_ = 1e3, range_ = 3e-3;  // Pa, m
  std::optional<double> given_range_;     // m
};
TACK_REGISTER(AdhesionLaw, SmoothAdhesion, "smooth", "Smooth traction with a finite range.", "");
}  // namespace tack
