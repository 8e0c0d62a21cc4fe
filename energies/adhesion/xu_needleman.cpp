// Normal part of the potential of Xu and Needleman: phi(d) = -W (1 + d/l) exp(-d/l). The traction W/l (d/l) exp(-d/l) is largest at the
// gap l, W / (e l). A taper to 0 at the range changes neither peak nor work of adhesion.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "energies/adhesion/strength_and_work.hpp"
#include "energies/adhesion/taper.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class XuNeedlemanAdhesion : public NormalLawOf<XuNeedlemanAdhesion, NormalAdhesion> {
 public:
  void fields(Fields& f) override {
    given_.fields(f, "peak_distance", "l: gap of the largest traction, W / (e peak_traction); the contact distance unless given, or fixed by the other two");
    f.optional_number("range", given_range_, units::length, "gap beyond which nothing adheres, at least 6 l; 12 l unless given").positive();
  }

  void prepare(const PairMaterials& m) override {
    const auto numbers = given_.resolve(std::numbers::e, m.contact_distance);
    peak_ = numbers.peak, work_ = numbers.work, length_ = numbers.length;
    range_ = given_range_.value_or(12 * length_);
    if (length_ < m.contact_distance * (1 - 1e-12))
      throw InputError(fmt::format("adhesion xu_needleman: the traction is largest at W / (e peak) = {:.6g} m, below the contact distance {:.6g} m, "
                                   "where the barrier pushes; raise work_of_adhesion or peak_distance, lower peak_traction or contact.distance",
                                   length_, m.contact_distance));
    if (range_ < 6 * length_ * (1 - 1e-12))
      throw InputError(fmt::format("adhesion xu_needleman: range {:.6g} m is less than 6 times {:.6g} m, the gap of the largest traction; raise it, or leave it out",
                                   range_, length_));
  }
  double range() const override { return range_; }
  double peak_traction() const override { return peak_; }
  double work_of_adhesion() const override { return work_; }

  template <class T>
  T energy(const T& d) const {
    using std::exp;
    const T u = d / T(length_);
    return T(-work_) * (T(1.0) + u) * exp(-u) * taper(d, range_);
  }

 private:
  StrengthAndWork given_;
  std::optional<double> given_range_;
  double peak_ = 1e3, work_ = std::numbers::e, length_ = 1e-3, range_ = 12e-3;
};

TACK_REGISTER(AdhesionLaw, XuNeedlemanAdhesion, "xu_needleman", "Exponential traction-separation law: the traction rises to its peak and decays.",
              "Xu, Needleman 1993, Void nucleation by inclusion debonding in a crystal matrix");

}  // namespace tack
