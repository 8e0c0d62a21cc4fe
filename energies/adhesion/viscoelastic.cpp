// Cohesive zone of a standard linear solid with irreversible damage: a spring K beside a Maxwell branch, a spring K_1 in series with a
// dashpot of relaxation time tau. Both fade with the damage D. With the effective opening l = sqrt(d^2 + (K_T / K) |u|^2) and its
// flow v in the dashpot, a bond stores
//     (1 - D) Y,   Y = K l^2 / 2 + K_1 <l - v>^2 / 2,
// and a step minimises over the flow v' and the damage b
//     phi = min over v', D <= b <= 1 of  (1 - b) (K l^2/2 + K_1 <l - v'>^2/2 + K_1 tau (v' - v)^2 / (2 h)) + g(b) - g(D).
// The flow is that of implicit Euler, v' = (h l + tau v) / (h + tau) for l > v. It leaves Y with K_1 / (1 + h / tau) in place of K_1.
// Then g'(b) = Y: the damage is that of the bilinear envelope at the opening sqrt(2 Y / K).
//   slow  v = l: the bilinear law, peak sigma, work W
//   fast  v = 0: the bilinear law of stiffness K + K_1 with the same work: peak sigma sqrt(1 + K_1 / K), work W
//   between, the dashpot adds to the work, most where a bond fails within about tau
//   held  the traction decays to K / (K + K_1) of that of a fast opening as exp(-t / tau)
// Limits: the flow is along the opening. A bond that unloads below its flow is slack in its branch (<>); slip that turns round
// finds the flow of the old direction.
#include <algorithm>
#include <cmath>

#include "energies/adhesion/bilinear_envelope.hpp"
#include "framework/bond/bond_law.hpp"
#include "framework/config/field.hpp"
#include "geometry/errors.hpp"

namespace tack {

class ViscoelasticAdhesion : public BondLawOf<ViscoelasticAdhesion> {
 public:
  struct HistoryVariables {
    double flow = 0;    // v [m]
    double damage = 0;  // D
  };

  void fields(Fields& f) override {
    f.number("peak_traction", strength_, units::pressure, "sigma: the strength under slow loading").required().positive();
    f.number("work_of_adhesion", work_, units::work_of_adhesion, "W: energy to separate unit area slowly").required().positive();
    f.optional_number("onset", given_onset_, units::length, "d_0: opening of the largest traction under slow loading; a tenth of 2 W / sigma unless given").positive();
    f.optional_number("stiffness", given_stiffness_, units::traction_stiffness, "K = sigma / d_0: traction per opening, slowly and before damage, instead of onset").positive();
    f.optional_number("tangential_strength", given_across_, units::pressure, "tau_t: strength along the surface under slow loading; sigma unless given").nonnegative();
    f.optional_number("branch_stiffness", given_branch_, units::traction_stiffness, "K_1 of the Maxwell branch, which fast loading adds to K; K unless given").nonnegative();
    f.number("relaxation_time", relaxation_time_, units::time, "tau: in which the traction of the branch decays to 1/e at a fixed opening").required().positive();
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
    envelope_ = {work_, onset, last};
  }
  double peak_traction() const override { return strength_; }
  double work_of_adhesion() const override { return work_; }

  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables& m, double h) const {
    const T squared = d * d + T(across_) * s;
    const double q = value_of(squared);
    const Driving y = driving(q, m.flow, branch_of_step(h));
    if (h == 0) return chained(squared, (1 - m.damage) * y.value, (1 - m.damage) * y.slope, (1 - m.damage) * y.curvature);
    const StepDamage to = damage_of_step(y.value, m.damage);
    return chained(squared, (1 - to.damage) * y.value + spent(m.damage, to.damage), (1 - to.damage) * y.slope, (1 - to.damage) * y.curvature - to.growth * y.slope * y.slope);
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const {
    const double q = at.d * at.d + across_ * at.s, l = std::sqrt(q);
    const double damage = damage_of_step(driving(q, m.flow, branch_of_step(at.h)).value, m.damage).damage;
    return {branch_ > 0 && l > m.flow ? std::min(l, (at.h * l + relaxation_time_ * m.flow) / (at.h + relaxation_time_)) : m.flow, damage};
  }
  double loss(const HistoryVariables& before, const HistoryVariables& after, const BondState& at) const {
    const double flowed = after.flow - before.flow;
    return spent(before.damage, after.damage) + (1 - after.damage) * branch_ * relaxation_time_ / at.h * flowed * flowed;
  }
  bool gone(const HistoryVariables& m, const BondState&) const { return m.damage >= 1; }
  double intensity(const HistoryVariables& m) const { return 1 - m.damage; }

 private:
  // Y and its derivatives by l^2.
  struct Driving {
    double value, slope, curvature;
  };
  struct StepDamage {
    double damage;
    double growth;  // by Y
  };

  // Returns the stiffness of the branch over a step whose flow is condensed [Pa/m].
  double branch_of_step(double h) const { return branch_ / (1 + h / relaxation_time_); }

  // q: l^2.
  Driving driving(double q, double flow, double branch) const {
    Driving y{stiffness_ * q / 2, stiffness_ / 2, 0};
    const double l = std::sqrt(q);
    if (!(l > flow)) return y;
    y.value += branch * (l - flow) * (l - flow) / 2;
    y.slope += branch / 2 * (1 - flow / l);
    y.curvature += branch * flow / (4 * l * q);
    return y;
  }
  StepDamage damage_of_step(double y, double before) const {
    const double x = std::sqrt(2 * y / stiffness_);
    if (before >= 1 || x >= envelope_.last) return {1, 0};
    const double damage = envelope_.damage(x);
    if (!(damage > before)) return {before, 0};
    return {std::min(damage, 1.0), envelope_.growth(x) / (stiffness_ * x)};
  }
  double spent(double before, double after) const { return after > before ? envelope_.spent(after) - envelope_.spent(before) : 0; }

  double strength_ = 1e4, work_ = 1, relaxation_time_ = 0.1;  // Pa, J/m^2, s
  std::optional<double> given_onset_, given_stiffness_, given_across_, given_branch_;
  double stiffness_ = 1e8, branch_ = 1e8;  // K, K_1 [Pa/m]
  double across_ = 1;                      // K_T / K
  BilinearEnvelope envelope_{1, 1e-5, 1e-4};
};

TACK_REGISTER(AdhesionLaw, ViscoelasticAdhesion, "viscoelastic",
              "Viscoelastic cohesive law: a standard linear solid (a spring beside a Maxwell branch) with irreversible damage. Strength grows with the speed; the work is largest where a bond fails within about "
              "the relaxation time.",
              "Musto and Alfano 2013");

}  // namespace tack
