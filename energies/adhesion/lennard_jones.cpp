// Attraction of two half spaces of Lennard-Jones solids: T = 8 W / (3 z) ((z/d)^3 - (z/d)^9) beyond the equilibrium gap z. The law is zero below z,
// where the barrier repels, so that surfaces rest between the contact distance and z. The traction peaks at 3^(1/6) z with
// 16 / (9 sqrt 3) W / z = 1.026 W / z. At z its slope jumps. A taper to 0 at the range changes neither peak nor work of adhesion.
#include <fmt/format.h>

#include <cmath>
#include <numbers>

#include "energies/adhesion/strength_and_work.hpp"
#include "energies/adhesion/taper.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class LennardJonesAdhesion : public NormalLawOf<LennardJonesAdhesion, NormalAdhesion> {
 public:
  void fields(Fields& f) override {
    given_.fields(f, "equilibrium_distance", "z: gap below which nothing pulls, 1.026 W / peak_traction; the contact distance unless given, or fixed by the other two");
    f.optional_number("range", given_range_, units::length, "gap beyond which nothing adheres, at least 5 z; 20 z unless given").positive();
  }

  void prepare(const PairMaterials& m) override {
    const auto numbers = given_.resolve(9 * std::numbers::sqrt3 / 16, m.contact_distance);
    peak_ = numbers.peak, work_ = numbers.work, z_ = numbers.length;
    range_ = given_range_.value_or(20 * z_);
    if (z_ < m.contact_distance * (1 - 1e-12))
      throw InputError(fmt::format("adhesion lennard_jones: the gap of equilibrium, {:.6g} m (1.026 W / peak), is below the contact distance {:.6g} m, from "
                                   "which on the barrier pushes; raise work_of_adhesion or equilibrium_distance, lower peak_traction or contact.distance",
                                   z_, m.contact_distance));
    if (range_ < 5 * z_ * (1 - 1e-12))
      throw InputError(fmt::format("adhesion lennard_jones: range {:.6g} m is less than 5 times {:.6g} m, the gap of equilibrium; raise it, or leave it out",
                                   range_, z_));
  }
  double range() const override { return range_; }
  double peak_traction() const override { return peak_; }
  double work_of_adhesion() const override { return work_; }
  std::string note() const override {
    const double at = z_ / range_;
    return fmt::format("lennard_jones: {:.2g}% of its work would be done beyond its range, {:.4g} m, and is done in the last quarter of it",
                       100 * (4 * at * at - std::pow(at, 8)) / 3, range_);
  }

  template <class T>
  T energy(const T& d) const {
    if (d < T(z_)) return T(-work_);
    const T u = T(z_) / d, u2 = u * u, u8 = u2 * u2 * u2 * u2;
    return T(-work_ / 3) * (T(4.0) * u2 - u8) * taper(d, range_);
  }

 private:
  StrengthAndWork given_;
  std::optional<double> given_range_;
  double peak_ = 1e3, work_ = 1, z_ = 1e-3, range_ = 20e-3;
};

TACK_REGISTER(AdhesionLaw, LennardJonesAdhesion, "lennard_jones", "Attraction of Lennard-Jones solids beyond their equilibrium (DMT).",
              "Derjaguin, Muller, Toporov 1975; Israelachvili, Intermolecular and Surface Forces");

}  // namespace tack
