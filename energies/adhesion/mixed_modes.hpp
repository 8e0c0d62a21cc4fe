// Mixed-mode failure of a bond. Mixity: B = K_T |u|^2 / (K d^2 + K_T |u|^2), 0 under opening alone,
// 1 under slip alone. G_I, G_II: works of both modes; sigma, tau: strengths.
//   power               G = (((1 - B) / G_I)^p + (B / G_II)^p)^(-1/p)
//                       onset: (t_n / sigma)^2 + (t_t / tau)^2 = 1
//   Benzeggagh-Kenane   G = G_I + (G_II - G_I) B^p
//                       onset^2 = o_I^2 + (o_II^2 - o_I^2) B^p (Turon et al. 2006)
// Onsets are values of lambda = sqrt(d^2 + (K_T / K) |u|^2). Without mixed modes, the tangential
// strength sets K_T / K = (tau / sigma)^2, and the work does not depend on the mixity.
#pragma once

#include <optional>
#include <string>

#include "framework/config/field.hpp"

namespace tack {

class MixedModes {
 public:
  enum class Criterion { none, power, benzeggagh_kenane };

  void fields(Fields& f);
  // The tangential strength defaults to the normal strength.
  double tangential_strength(double strength) const { return strength_.value_or(strength); }
  std::optional<double> given_tangential_strength() const { return strength_; }
  double tangential_work(double work) const { return work_.value_or(work); }
  bool mixed() const { return criterion_ != Criterion::none; }

  // Values under opening alone and under slip alone.
  void set_work(double opening, double slip) { work_1_ = opening, work_2_ = slip; }
  void set_onset(double opening, double slip) { onset_1_ = opening, onset_2_ = slip; }
  double work(double mixity) const;   // J/m^2
  double onset(double mixity) const;  // of lambda [m]

 private:
  double power() const { return exponent_.value_or(criterion_ == Criterion::power ? 1 : 2); }

  Criterion criterion_ = Criterion::none;
  std::optional<double> strength_, work_, exponent_;  // Pa, J/m^2
  double work_1_ = 1, work_2_ = 1, onset_1_ = 1, onset_2_ = 1;
};

}  // namespace tack
