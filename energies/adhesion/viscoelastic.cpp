// Cohesive zone of a standard linear solid with irreversible damage: a spring K beside a Maxwell branch, a spring K_1 in series with a
// dashpot of relaxation time tau. Both fade with the damage D. With c = K_T / K, the jump x = (d, sqrt(c) u) of opening and slip and its flow v
// in the dashpot, a bond stores
//     (1 - D) Y,   Y = K |x|^2 / 2 + K_1 |x - v|^2 / 2   (d - v_d counts as 0 below 0),
// and a step minimises over the flow v' and the damage b
//     phi = min over v', D <= b <= 1 of  (1 - b) (K |x|^2/2 + K_1 |x - v'|^2/2 + K_1 tau |v' - v|^2 / (2 h)) + g(b) - g(D).
// The flow is that of implicit Euler, v' = v + (x - v) h / (h + tau). It leaves Y with K_1 / (1 + h / tau) in place of K_1.
// Then g'(b) = Y: the damage is that of the bilinear envelope at the opening sqrt(2 Y / K).
//   slow  v = x: the bilinear law, peak sigma, work W
//   fast  v = 0: the bilinear law of stiffness K + K_1 with the same work: peak sigma sqrt(1 + K_1 / K), work W
//   between, the dashpot adds to the work, most where a bond fails within about tau
//   held  the traction decays to K / (K + K_1) of that of a fast opening as exp(-t / tau)
// The relaxation time at the temperature T is tau a_T (temperature_shift.hpp).
// The stored energy does not depend on the temperature. Limit: a bond whose opening falls below its flow is slack along the normal in
// its branch, which does not flow back.
#include <algorithm>
#include <cmath>

#include "energies/adhesion/bilinear_envelope.hpp"
#include "framework/bond/bond_law.hpp"
#include "framework/bond/temperature_shift.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {

class ViscoelasticAdhesion : public BondLawOf<ViscoelasticAdhesion> {
 public:
  struct HistoryVariables {
    double flow = 0, flow_x = 0, flow_y = 0;  // v along the normal and both tangents, the latter times sqrt(c) [m]
    double damage = 0;                        // D
  };

  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength under slow loading").required().positive();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W: energy to separate unit area slowly").required().positive();
    f.optional_number("onset", given_onset_, units::length, "d_0: opening of the largest traction under slow loading; a tenth of 2 W / sigma unless given").positive();
    f.optional_number("stiffness", given_stiffness_, units::traction_stiffness, "K = sigma / d_0: traction per opening, slowly and before damage, instead of onset").positive();
    f.optional_number("tangential_strength", given_across_, units::pressure, "tau_t: strength along the surface under slow loading; sigma unless given").nonnegative();
    f.optional_number("branch_stiffness", given_branch_, units::traction_stiffness, "K_1 of the Maxwell branch, which fast loading adds to K; K unless given").nonnegative();
    f.number("relaxation_time", relaxation_time_, units::time, "tau: in which the traction of the branch decays to 1/e at a fixed opening").required().positive();
    shift_.fields(f, "relaxation_time");
    f.check("stiffness", [this]() -> std::string { return given_stiffness_ && given_onset_ ? "follows from onset: drop one of the two" : ""; });
  }
  void prepare(const PairMaterials&) override {
    const double last = 2 * work_ / strength_;
    const double onset = given_stiffness_ ? strength_ / *given_stiffness_ : given_onset_.value_or(last / 10);
    if (!(onset < last * (1 - 1e-6)))
      throw InputError("adhesion viscoelastic: the work is done before the traction is largest; raise the work or the stiffness, or lower the strength or the onset");
    stiffness_ = strength_ / onset;
    branch_ = given_branch_.value_or(stiffness_);
    const double ratio = given_across_.value_or(strength_) / strength_;
    across_ = ratio * ratio;
    root_ = ratio;
    envelope_ = {work_, onset, last};
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }
  bool depends_on_temperature() const override { return shift_.shifts(); }

  template <class T>
  T energy(const T& d, const Slip<T>& u, const HistoryVariables& m, double h, const SiteState& site) const {
    const double branch = h > 0 ? branch_ / (1 + h / relaxation_time(site)) : branch_;
    const T x = T(root_) * u.x, y = T(root_) * u.y;
    const T along = d > T(m.flow) ? d - T(m.flow) : T(0), across_x = x - T(m.flow_x), across_y = y - T(m.flow_y);
    const T driving = T(stiffness_ / 2) * (d * d + x * x + y * y) + T(branch / 2) * (along * along + across_x * across_x + across_y * across_y);
    if (h == 0) return T(1 - m.damage) * driving;
    const double value = value_of(driving);
    const StepDamage to = damage_of_step(value, m.damage);
    return chained(driving, (1 - to.damage) * value + spent(m.damage, to.damage), 1 - to.damage, -to.growth);
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const {
    const double relaxation = relaxation_time(at.site), flowing = branch_ > 0 ? at.h / (at.h + relaxation) : 0;
    const double x = root_ * at.slip.x() - m.flow_x, y = root_ * at.slip.y() - m.flow_y, d = std::max(at.d - m.flow, 0.0);
    const double driving = stiffness_ / 2 * (at.d * at.d + across_ * at.slip.squaredNorm()) + branch_ / (1 + at.h / relaxation) / 2 * (d * d + x * x + y * y);
    return {m.flow + flowing * d, m.flow_x + flowing * x, m.flow_y + flowing * y, damage_of_step(driving, m.damage).damage};
  }
  double loss(const HistoryVariables& before, const HistoryVariables& after, const BondState& at) const {
    const double flowed = Vec3(after.flow - before.flow, after.flow_x - before.flow_x, after.flow_y - before.flow_y).squaredNorm();
    return spent(before.damage, after.damage) + (1 - after.damage) * branch_ * relaxation_time(at.site) / at.h * flowed;
  }
  bool gone(const HistoryVariables& m, const BondState&) const { return m.damage >= 1; }
  double intensity(const HistoryVariables& m) const { return 1 - m.damage; }

 private:
  struct StepDamage {
    double damage;
    double growth;  // by Y
  };

  // Returns tau a_T [s].
  double relaxation_time(const SiteState& site) const {
    return relaxation_time_ * shift_.factor(site.temperature);
  }
  StepDamage damage_of_step(double y, double before) const {
    const double x = std::sqrt(2 * y / stiffness_);
    if (before >= 1 || x >= envelope_.last) return {1, 0};
    const double damage = envelope_.damage(x);
    if (!(damage > before)) return {before, 0};
    return {std::min(damage, 1.0), envelope_.growth(x) / (stiffness_ * x)};
  }
  double spent(double before, double after) const { return after > before ? envelope_.spent(after) - envelope_.spent(before) : 0; }

  TemperatureShift shift_;
  double strength_ = 1e4, work_ = 1, relaxation_time_ = 0.1;  // Pa, J/m^2, s
  std::optional<double> given_onset_, given_stiffness_, given_across_, given_branch_;
  double stiffness_ = 1e8, branch_ = 1e8;  // K, K_1 [Pa/m]
  double across_ = 1, root_ = 1;           // c = K_T / K and its root
  BilinearEnvelope envelope_{1, 1e-5, 1e-4};
};

TACK_REGISTER(AdhesionLaw, ViscoelasticAdhesion, "viscoelastic",
              "Viscoelastic cohesive law: a standard linear solid (a spring beside a Maxwell branch) with irreversible damage. Strength grows with the speed; the work is largest where a bond fails within about "
              "the relaxation time.",
              "Musto and Alfano 2013; Williams, Landel and Ferry 1955");

}  // namespace tack
