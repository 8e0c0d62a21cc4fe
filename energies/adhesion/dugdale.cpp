// Dugdale: a constant traction sigma up to the gap W / sigma, zero beyond. The traction falls over an interval around that gap,
// T = sigma (3 u^2 - 2 u^3), so that its derivative is continuous and the work of adhesion stays W.
#include <fmt/format.h>

#include <algorithm>

#include "energies/adhesion/strength_and_work.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class DugdaleAdhesion : public NormalLawOf<DugdaleAdhesion, NormalAdhesion> {
 public:
  void fields(Fields& f) override {
    given_.fields(f, "range", "gap beyond which nothing adheres, (1 + spread) W / peak_traction; twice the contact distance unless given, or fixed by the other two");
    f.number("spread", spread_, units::none, "fraction of W / peak_traction, on either side of it, over which the traction falls").range(1e-3, 0.5);
  }

  void prepare(const PairMaterials& m) override {
    const auto numbers = given_.resolve(1 / (1 + spread_), 2 * m.contact_distance);
    sigma_ = numbers.peak;
    const double gap = numbers.work / sigma_;
    begin_ = (1 - spread_) * gap, end_ = (1 + spread_) * gap;
    if (begin_ < m.contact_distance)
      throw InputError(fmt::format("adhesion dugdale: the traction falls from {:.6g} m on, within the contact distance {:.6g} m, where the barrier "
                                   "pushes; raise work_of_adhesion or range, lower peak_traction, spread or contact.distance", begin_, m.contact_distance));
  }
  double range() const override { return end_; }
  double peak_traction() const override { return sigma_; }
  double work_of_adhesion() const override { return sigma_ * (begin_ + end_) / 2; }

  template <class T>
  T energy(const T& d) const {
    const double width = end_ - begin_;
    if (d < T(begin_)) return T(sigma_) * (d - T((begin_ + end_) / 2));
    const T u = (T(end_) - d) / T(width);
    return T(-sigma_ * width) * u * u * u * (T(1.0) - T(0.5) * u);
  }

 private:
  StrengthAndWork given_;
  double spread_ = 0.05;
  double sigma_ = 1e3, begin_ = 0.95e-3, end_ = 1.05e-3;  // Pa, m
};

TACK_REGISTER(AdhesionLaw, DugdaleAdhesion, "dugdale", "Constant traction up to a gap, zero beyond.",
              "Dugdale 1960, Yielding of steel sheets containing slits; Maugis 1992");

}  // namespace tack
