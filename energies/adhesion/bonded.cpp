// Glued surfaces: bonds are stiff and do not creep as long as (t_n / sigma)^2 + (t_t / tau)^2 < 1. Beyond that they break for good, within a
// thousandth of the opening at which they begin to break (damage_law.hpp).
#include "energies/adhesion/bilinear_envelope.hpp"
#include "energies/adhesion/damage_law.hpp"
#include "framework/config/field.hpp"

namespace tack {

class BondedAdhesion : public DamageLawOf<BondedAdhesion> {
 public:
  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength along the normal").required().positive();
    f.optional_number("tangential_strength", tangential_strength_, units::pressure,
                      "tau: the tangential strength; peak_traction unless given. 0: none").nonnegative();
    f.optional_number("onset", given_onset_, units::length,
                      "opening at which a bond breaks: 1e-6 m unless given, or a thousandth of the contact distance if that is less").positive();
    f.optional_number("stiffness", given_stiffness_, units::traction_stiffness, "traction per opening, instead of onset").positive();
    f.check("stiffness", [this]() -> std::string { return given_stiffness_ && given_onset_ ? "follows from onset: drop one of the two" : ""; });
  }
  void prepare(const PairMaterials& pair) override {
    double onset = pair.contact_distance > 0 ? std::min(1e-6, 1e-3 * pair.contact_distance) : 1e-6;
    onset = given_stiffness_ ? strength_ / *given_stiffness_ : given_onset_.value_or(onset);
    const double ratio = tangential_strength_.value_or(strength_) / strength_, last = onset * (1 + 1e-3);
    stiffness_ = strength_ / onset;
    across_ = ratio * ratio * stiffness_;
    envelope_ = {strength_ * last / 2, onset, last};
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return envelope_.work; }

  bool mixed() const { return false; }
  double broken() const { return 1; }
  const BilinearEnvelope& envelope(double) const { return envelope_; }

 private:
  double strength_ = 1e4;  // Pa
  std::optional<double> tangential_strength_, given_onset_, given_stiffness_;
  BilinearEnvelope envelope_{5e-3, 1e-6, 1.001e-6};
};

TACK_REGISTER(AdhesionLaw, BondedAdhesion, "bonded", "Brittle cohesive law: bonds carry load without creep up to their strength, then break.", "");

}  // namespace tack
