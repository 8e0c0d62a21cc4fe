// Cohesive zone with the traction T = sigma l exp(1 - l), l = lambda / d_0, W = e sigma d_0, and irreversible damage
// D = 1 - exp(-l) (damage_law.hpp), in mixed modes by the criteria of mixed_modes.hpp. A bond is gone from l = 12 on, where 1e-4 of the work
// is left.
#include <limits>
#include <numbers>

#include "energies/adhesion/damage_law.hpp"
#include "energies/adhesion/mixed_modes.hpp"
#include "framework/config/field.hpp"

namespace tack {

class ExponentialAdhesion : public DamageLawOf<ExponentialAdhesion> {
 public:
  struct Envelope {
    double work, scale;  // J/m^2, m

    double end() const { return std::numeric_limits<double>::infinity(); }
    double damage(double x) const { return -std::expm1(-x / scale); }
    double growth(double x) const { return std::exp(-x / scale) / scale; }
    double opening(double damage) const { return -scale * std::log1p(-damage); }
    // W (1 - (1 + l + l^2/2) exp(-l)).
    double spent(double damage) const {
      const double l = -std::log1p(-damage);
      return damage < 1 ? work * (1 - (1 - damage) * (1 + l + l * l / 2)) : work;
    }
  };

  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength").required().positive();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W: energy to separate unit area; the traction is largest at W / (e sigma)").required().positive();
    modes_.fields(f);
    f.number("viscosity", viscosity_, units::surface_viscosity, "eta: viscous resistance to the growth of damage").nonnegative();
  }
  void prepare(const PairMaterials&) override {
    const double across = modes_.tangential_strength(strength_), work = modes_.tangential_work(work_);
    const auto stiffness = [](double strength, double energy) { return std::numbers::e * std::numbers::e * strength * strength / energy; };
    stiffness_ = stiffness(strength_, work_);
    across_ = stiffness(across, work);
    modes_.set_work(work_, work);
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }

  bool mixed() const { return modes_.mixed(); }
  double broken() const { return -std::expm1(-12.0); }
  Envelope envelope(double mixity) const {
    const double work = modes_.work(mixity);
    return {work, std::sqrt(work / stiffness_)};
  }

 private:
  double strength_ = 1e4, work_ = 1;  // Pa, J/m^2
  MixedModes modes_;
};

TACK_REGISTER(AdhesionLaw, ExponentialAdhesion, "exponential", "Exponential cohesive law; damage is irreversible.",
              "Ortiz and Pandolfi 1999");

}  // namespace tack
