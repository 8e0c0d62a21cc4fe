// Adhesion with irreversible damage D. A bond stores (1 - D) k / 2 with k = K d^2 + K_T |u|^2
// [J/m^2], and damage to D dissipates g(D). A step from D has the potential
//     phi = min over D <= b <= 1 of  (1 - b) k / 2 + g(b) - g(D) + eta / (2 h) (b - D)^2,
//     d phi / d k = (1 - b) / 2.
//   eta = 0  g'(b) = k / 2: the traction follows an envelope of the opening lambda = sqrt(k / K),
//            and unloads and reloads along a line through the origin
//   eta > 0  g'(b) + eta/h (b - D) = k / 2
// A law defines g by an envelope, the damage as a function of the opening:
//     struct Envelope {
//       double end() const;                    // the opening at which D = 1, or infinity
//       double damage(double opening) const;   // positive above an onset
//       double growth(double opening) const;   // derivative of damage [1/m]
//       double opening(double damage) const;   // inverse of damage; the onset for 0
//       double spent(double damage) const;     // g [J/m^2]
//     };
//     Envelope envelope(double mixity) const;
//     bool mixed() const;       // true if the envelope depends on the mixity K_T |u|^2 / k
//     double broken() const;    // the damage at which a bond is broken
// The mixity is lagged: with the mixity of the end of the step there is no potential. A bond is
// elastic until it has opened far enough to have a mixity. The history variable is the damage, so
// that a change of mixity cannot heal a bond.
#pragma once

#include <algorithm>
#include <cmath>

#include "framework/bond/bond_law.hpp"

namespace tack {

/// History variables of a damage law.
struct Damage {
  double damage = 0;
  double mixity = -1;  // none yet
};

/// Base of damage laws; `Law` defines the envelope.
template <class Law>
class DamageLawOf : public BondLawOf<Law> {
 public:
  using HistoryVariables = Damage;

  template <class T>
  T energy(const T& d, const T& s, const HistoryVariables& m, double h) const {
    const T pulled = pull(d, s);
    const double k = value_of(pulled);
    const StepDamage to = damage_of_step(k, m, h);
    double phi = (1 - to.damage) * k / 2;
    if (to.damage > m.damage) phi += spent(m, to.damage) + viscous(m, to.damage, h) / 2;
    return chained(pulled, phi, (1 - to.damage) / 2, -to.growth / 2);
  }
  HistoryVariables after(const HistoryVariables& m, const BondState& at) const {
    const double k = pull(at.d, at.s);
    HistoryVariables now{damage_of_step(k, m, at.h).damage, m.mixity};
    if (law().mixed()) {
      const double least = least_opening * law().envelope(0).opening(0.5);
      if (k > stiffness_ * least * least) now.mixity = across_ * at.s / k;
    }
    return now;
  }
  double loss(const HistoryVariables& before, const HistoryVariables& after,
              const BondState& at) const {
    return after.damage > before.damage
               ? spent(before, after.damage) + viscous(before, after.damage, at.h)
               : 0;
  }
  bool gone(const HistoryVariables& m, const BondState&) const {
    return m.damage >= law().broken();
  }
  double intensity(const HistoryVariables& m) const { return 1 - m.damage; }

 protected:
  double stiffness_ = 1e8, across_ = 1e8;  // K, K_T [Pa/m]
  double viscosity_ = 0;                   // eta [J s/m^2]

 private:
  // Opening from which a mixity counts, over the opening at D = 1/2
  static constexpr double least_opening = 1e-3;

  struct StepDamage {
    double damage;
    double growth;  // by k
  };

  const Law& law() const { return static_cast<const Law&>(*this); }

  template <class T>
  T pull(const T& d, const T& s) const {
    return T(stiffness_) * d * d + T(across_) * s;
  }
  double spent(const HistoryVariables& m, double damage) const {
    const auto envelope = law().envelope(m.mixity);
    return envelope.spent(damage) - envelope.spent(m.damage);
  }
  double viscous(const HistoryVariables& m, double damage, double h) const {
    return viscosity_ > 0 ? viscosity_ / h * (damage - m.damage) * (damage - m.damage) : 0;
  }

  StepDamage damage_of_step(double k, const HistoryVariables& m, double h) const {
    const StepDamage unchanged{m.damage, 0};
    if (h == 0 || m.damage >= 1 || (law().mixed() && m.mixity < 0)) return unchanged;
    const auto envelope = law().envelope(m.mixity);
    const double from = envelope.opening(m.damage), lambda = std::sqrt(k / stiffness_),
                 end = envelope.end();
    if (!(lambda > from)) return unchanged;
    const double c = viscosity_ > 0 ? viscosity_ / h : 0;
    if (lambda >= end && stiffness_ * (lambda - end) * (lambda + end) / 2 >= c * (1 - m.damage))
      return {1, 0};
    const double to =
        c > 0 ? solve(envelope, m.damage, c, from, std::min(lambda, end), lambda) : lambda;
    const double growth = envelope.growth(to);
    return {std::clamp(envelope.damage(to), m.damage, 1.0),
            growth / (2 * (stiffness_ * to + c * growth))};
  }

  // Returns the root x in [low, high] of K (x^2 - lambda^2) / 2 + c (D(x) - D), which increases
  // with x: Newton's method within bisection.
  template <class Envelope>
  double solve(const Envelope& envelope, double damage, double c, double low, double high,
               double lambda) const {
    double x = high;
    for (int i = 0; i < 200; ++i) {
      const double excess =
          stiffness_ * (x - lambda) * (x + lambda) / 2 + c * (envelope.damage(x) - damage);
      (excess > 0 ? high : low) = x;
      const double newton = x - excess / (stiffness_ * x + c * envelope.growth(x)),
                   least = 1e-15 * x;
      if (std::abs(newton - x) <= least || high - low <= least) break;
      x = newton > low && newton < high ? newton : 0.5 * (low + high);
    }
    return x;
  }
};

}  // namespace tack
