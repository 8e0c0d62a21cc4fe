#include "energies/hyperelastic/energy_formula.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/errors.hpp"

namespace tack {

const std::vector<std::string>& EnergyFormula::variables() {
  static const std::vector<std::string> names = {"s1", "s2", "s3", "I1", "I2", "J", "I1_bar", "I2_bar"};
  return names;
}

EnergyFormula::EnergyFormula(const std::string& text, const std::map<std::string, Quantity>& parameters, bool of_volume) {
  if (text.empty()) return;
  std::map<std::string, double> constants;
  for (const auto& [name, quantity] : parameters) {
    if (name == "pi" || std::count(variables().begin(), variables().end(), name)) throw InputError(fmt::format("the parameter '{}' is something else in this formula; take another name", name));
    constants[name] = quantity.si;
  }
  program_.emplace(text, variables(), constants);
  for (int i = 0; of_volume && i < static_cast<int>(variables().size()); ++i)
    if (variables()[i] != "J" && program_->uses(i)) throw InputError(fmt::format("'{}' has {}, and an energy of the volume is a formula of J; move it to `energy`", text, variables()[i]));
  for (int i = 3; i < 8; ++i) any_invariant_ = any_invariant_ || program_->uses(i);
  any_isochoric_ = program_->uses(6) || program_->uses(7);
  using Jet = PackJet<double, 1>;
  const auto at = [&](double a, double b, double c) { return (*this)(std::array<Jet, 3>{Jet(a), Jet(b), Jet(c)}).v; };
  rest_ = at(1, 1, 1);
  if (!std::isfinite(rest_)) throw InputError(fmt::format("'{}' is {} at rest (all stretches 1, I1 and I2 3)", text, rest_));
  constexpr double a = 1.03, b = 0.98, c = 1.01, round_off = 1e-9;
  const double once = at(a, b, c);
  for (const double other : {at(b, c, a), at(c, a, b), at(b, a, c)})
    if (!(std::abs(other - once) <= round_off * std::abs(once)))
      throw InputError(fmt::format("'{}' changes when s1, s2 and s3 change places ({:.6g} and {:.6g} at 1.03, 0.98, 1.01), and an isotropic material has no first direction; write it for all three alike", text,
                                   once, other));
}

}  // namespace tack
