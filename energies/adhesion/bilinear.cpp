// Cohesive zone with irreversible damage (damage_law.hpp): the traction rises linearly to sigma at the onset d_0 and falls linearly to 0 at
// 2 W / sigma, where the work W is done. Mixed modes by the criteria of mixed_modes.hpp.
#include <fmt/format.h>

#include "energies/adhesion/bilinear_envelope.hpp"
#include "energies/adhesion/damage_law.hpp"
#include "energies/adhesion/mixed_modes.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {

class BilinearAdhesion : public DamageLawOf<BilinearAdhesion> {
 public:
  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength").required().positive();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W: energy to separate unit area").required().positive();
    f.optional_number("onset", given_onset_, units::length, "d_0: opening of the largest traction; a tenth of 2 W / sigma unless given").positive();
    f.optional_number("stiffness", given_stiffness_, units::traction_stiffness, "K = sigma / d_0: traction per opening before damage, instead of "
                                                                                "onset").positive();
    f.optional_number("tangential_stiffness", given_across_, units::traction_stiffness, "K_T: tangential traction per slip before damage; K (tau / "
                                                                                        "sigma)^2 unless given").positive();
    modes_.fields(f);
    f.number("viscosity", viscosity_, units::surface_viscosity, "eta: viscous resistance to the growth of damage").nonnegative();
    f.check("stiffness", [this]() -> std::string { return given_stiffness_ && given_onset_ ? "follows from onset: drop one of the two" : ""; });
    f.check("tangential_stiffness", [this]() -> std::string {
      const bool twice = given_across_ && !modes_.mixed() && modes_.given_tangential_strength();
      return twice ? "follows from tangential_strength without mixed_mode: drop one of the two" : "";
    });
  }
  void prepare(const PairMaterials&) override {
    const double last = 2 * work_ / strength_;
    const double onset = given_stiffness_ ? strength_ / *given_stiffness_ : given_onset_.value_or(last / 10);
    stiffness_ = strength_ / onset;
    const double across = modes_.tangential_strength(strength_), ratio = across / strength_;
    across_ = given_across_.value_or(ratio * ratio * stiffness_);
    check_ends("an opening", onset, last);
    const double work = modes_.tangential_work(work_), slip_onset = across > 0 ? across / across_ : 0;
    if (modes_.mixed()) check_ends("a slip", slip_onset, 2 * work / across);
    modes_.set_work(work_, work);
    modes_.set_onset(onset, slip_onset * std::sqrt(across_ / stiffness_));
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }

  bool mixed() const { return modes_.mixed(); }
  double broken() const { return 1; }
  BilinearEnvelope envelope(double mixity) const {
    const double work = modes_.work(mixity), onset = modes_.onset(mixity);
    return {work, onset, 2 * work / (stiffness_ * onset)};
  }

 private:
  static void check_ends(const char* of, double onset, double last) {
    if (onset < last * (1 - 1e-6)) return;
    throw InputError(fmt::format("adhesion bilinear: the traction is largest at {} of {:.6g} m, and the work is done at {:.6g} m; raise the work or the "
                                 "stiffness, or lower the strength or the onset", of, onset, last));
  }

  double strength_ = 1e4, work_ = 1;  // Pa, J/m^2
  std::optional<double> given_onset_, given_stiffness_, given_across_;
  MixedModes modes_;
};

TACK_REGISTER(AdhesionLaw, BilinearAdhesion, "bilinear", "Bilinear cohesive law: the traction rises and falls linearly; damage is irreversible.",
              "Camanho and Davila 2002; Turon, Camanho, Costa and Davila 2006");

}  // namespace tack
