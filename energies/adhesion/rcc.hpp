// Base of both forms of Raous-Cangemi-Cocou adhesion (the paper, eq. 5 and 6). A bond stores the
// energy k beta^2 / 2 with k = C_N d^2 + C_T |u|^2 [J/m^2]. Its intensity beta is the history
// variable. A bond with beta < 0.01 that does not grow has failed; its site forms a new, unstressed
// bond under pressure.
#pragma once

#include <cmath>
#include <optional>

#include "framework/bond/bond_law.hpp"
#include "framework/config/field.hpp"

namespace tack {

struct RccIntensity {
  double beta = 1;
};

template <class Law>
class RccLawOf : public BondLawOf<Law> {
 public:
  using HistoryVariables = RccIntensity;

  void fields(Fields& f) override {
    f.number("normal_stiffness", normal_, units::traction_stiffness,
             "C_N: normal traction per opening")
        .required()
        .positive();
    f.number("tangential_stiffness", across_, units::traction_stiffness,
             "C_T: tangential traction per slip; 0: none")
        .nonnegative();
    f.number("work_of_adhesion", work_, units::work_of_adhesion,
             "W: energy to separate unit area slowly; the traction peaks at sqrt(W C_N), when the "
             "opening is sqrt(W / C_N)")
        .required()
        .nonnegative();
    f.number("healing", healing_, units::fluidity,
             "r: healing rate per contact pressure; 0: no healing")
        .nonnegative();
    f.number("saturation", saturation_, units::pressure,
             "p_0: contact pressure that heals bonds fully; a lower pressure p heals to p / p_0. "
             "0: any pressure heals fully")
        .nonnegative();
    f.optional_number(
         "intensity", intensity_, units::none,
         "intensity of new bonds; unless given 1, and 0 for healing bonds that form during a run")
        .range(0, 1);
  }
  void prepare(const PairMaterials&) override {}
  double peak_traction() const override { return std::sqrt(work_ * normal_); }
  double work_of_adhesion() const override { return work_; }
  bool bonds_on_contact() const override { return healing_ > 0; }
  bool resists_pressing() const override { return !(healing_ > 0); }

  HistoryVariables begin(bool on_contact) const {
    return {intensity_.value_or(on_contact && healing_ > 0 ? 0 : 1)};
  }
  double intensity(const HistoryVariables& m) const { return m.beta; }

 protected:
  static constexpr double weak = 0.01;

  template <class T>
  T pull(const T& d, const T& s) const {
    return T(normal_) * d * d + T(across_) * s;
  }

  double normal_ = 1e8, across_ = 0;     // Pa/m
  double work_ = 1, viscosity_ = 0;      // J/m^2, J s/m^2
  double healing_ = 0, saturation_ = 0;  // 1/(Pa s), Pa
  std::optional<double> intensity_;
};

}  // namespace tack
