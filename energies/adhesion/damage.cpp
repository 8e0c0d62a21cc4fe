// Irreversible damage (damage_law.hpp) with the envelope of any reversible adhesion law: a table, a formula or a registered law. The law gives the
// traction of an intact bond by its opening.
#include "energies/adhesion/damage_law.hpp"
#include "energies/adhesion/sampled_envelope.hpp"
#include "framework/config/field.hpp"
#include "framework/contact/normal_law.hpp"
#include "geometry/errors.hpp"

namespace tack {

class EnvelopeAdhesion : public DamageLawOf<EnvelopeAdhesion> {
 public:
  void fields(Fields& f) override {
    f.component("envelope", envelope_,
                "a traction-separation law of the gap, evaluated at the opening: the traction under monotonic loading; must be 0 at opening 0").required();
    f.optional_number("tangential_strength", tangential_strength_, units::pressure,
                      "tau: the largest tangential traction; that of the envelope unless given. 0: none").nonnegative();
    f.number("viscosity", viscosity_, units::surface_viscosity, "eta: viscous resistance to the growth of damage").nonnegative();
  }
  void prepare(const PairMaterials& pair) override {
    const auto* given = dynamic_cast<const NormalAdhesion*>(envelope_.get());
    if (!given) throw InputError("adhesion damage: its envelope has to be an adhesion of the gap, as table, expression or fang");
    const std::unique_ptr<NormalLaw> law = given->clone();
    PairMaterials opening = pair;
    opening.contact_distance = 0;  // openings have no contact distance
    law->prepare(opening);
    const auto& adhesion = dynamic_cast<const AdhesionLaw&>(*law);
    note_ = adhesion.note();
    doubts_ = adhesion.warnings();
    strength_ = adhesion.peak_traction();
    work_ = adhesion.work_of_adhesion();
    sampled_ = SampledEnvelope([&](double x) { return law->at(x).slope; }, law->range(), "adhesion damage: envelope");
    stiffness_ = sampled_.stiffness();
    const double ratio = tangential_strength_.value_or(strength_) / strength_;
    across_ = ratio * ratio * stiffness_;
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }
  std::string note() const override { return note_; }
  std::vector<std::string> warnings() const override { return doubts_; }

  bool mixed() const { return false; }
  double broken() const { return 1; }
  const SampledEnvelope& envelope(double) const { return sampled_; }

 private:
  std::shared_ptr<const AdhesionLaw> envelope_;
  std::optional<double> tangential_strength_;
  SampledEnvelope sampled_;
  double strength_ = 1, work_ = 1;  // Pa, J/m^2
  std::string note_;
  std::vector<std::string> doubts_;
};

TACK_REGISTER(AdhesionLaw, EnvelopeAdhesion, "damage", "Cohesive law whose envelope is a traction-separation law of the gap; damage is irreversible.", "");

}  // namespace tack
