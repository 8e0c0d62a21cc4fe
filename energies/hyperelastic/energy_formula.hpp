// A density psi(F) of an isotropic material as a formula of a scene, in any of
//     s1, s2, s3          principal stretches
//     I1, I2, J           invariants of C = F^T F: tr C, (tr(C)^2 - tr(C^2)) / 2, and det F
//     I1_bar, I2_bar      those of the isochoric part: J^(-2/3) I1, J^(-4/3) I2
// and its derivatives in stretches (pack_jet.hpp). The energy at rest is subtracted.
#pragma once

#include <map>
#include <optional>
#include <string>

#include "energies/hyperelastic/pack_jet.hpp"
#include "framework/config/field.hpp"
#include "framework/config/formula_program.hpp"

namespace tack {

class EnergyFormula {
 public:
  static const std::vector<std::string>& variables();

  /// Throws InputError, without a source location, unless the text is a formula of the variables
  /// that does not change when stretches change places, and finite at rest. Zero without a text.
  /// of_volume: the formula may have J alone.
  EnergyFormula(const std::string& text, const std::map<std::string, Quantity>& parameters,
                bool of_volume = false);
  EnergyFormula() = default;

  bool uses(const std::string& parameter) const { return program_ && program_->uses(parameter); }

  /// Returns psi of three stretches that depend on N variables [J/m^3].
  template <class Jet>
  Jet operator()(const std::array<Jet, 3>& s) const {
    if (!program_) return Jet(0.0);
    Jet all[8];
    for (int i = 0; i < 3; ++i) all[i] = s[i];
    if (any_invariant_) {
      const Jet x = s[0] * s[0], y = s[1] * s[1], z = s[2] * s[2];
      all[3] = x + y + z;
      all[4] = x * y + y * z + z * x;
      all[5] = s[0] * s[1] * s[2];
      if (any_isochoric_) {
        all[6] = power(all[5], -2.0 / 3) * all[3];
        all[7] = power(all[5], -4.0 / 3) * all[4];
      }
    }
    return (*program_)(all)-Jet(rest_);
  }

 private:
  std::optional<FormulaProgram> program_;
  bool any_invariant_ = false, any_isochoric_ = false;
  double rest_ = 0;  // J/m^3
};

}  // namespace tack
