#include "energies/adhesion/mixed_modes.hpp"

#include <cmath>

namespace tack {

void MixedModes::fields(Fields& f) {
  f.optional_number("tangential_strength", strength_, units::pressure, "tau: the largest tangential traction; peak_traction unless given. 0: none").nonnegative();
  f.choice("mixed_mode", criterion_,
           {{"none", Criterion::none, "the work of separation is the same in every mode"},
            {"power", Criterion::power, "power law of the works of the modes, quadratic onset criterion of the strengths"},
            {"benzeggagh_kenane", Criterion::benzeggagh_kenane, "work and onset depend on a power of the mode mixity"}},
           "failure criterion if opening and slip act together");
  f.optional_number("tangential_work", work_, units::work_of_adhesion, "G_II: energy to separate unit area by slip, for mixed_mode").positive();
  f.optional_number("mixity_exponent", exponent_, units::none,
                    "exponent of the criterion; power: at least 1, and 1 unless given; benzeggagh_kenane: 2 unless given").positive();
  f.check("tangential_work", [this]() -> std::string {
    if (mixed() == work_.has_value()) return "";
    return mixed() ? "mixed_mode needs tangential_work: add it" : "is of mixed modes: choose mixed_mode, or drop it";
  });
  f.check("mixity_exponent", [this]() -> std::string {
    if (!exponent_ || (mixed() && !(criterion_ == Criterion::power && *exponent_ < 1))) return "";
    return mixed() ? "must be at least 1 for mixed_mode: power" : "is of mixed modes: choose mixed_mode, or drop it";
  });
  f.check("tangential_strength", [this]() -> std::string {
    return mixed() && strength_ == 0.0 ? "must be positive for mixed modes" : "";
  });
}

double MixedModes::work(double mixity) const {
  if (criterion_ == Criterion::none) return work_1_;
  const double p = power();
  if (criterion_ == Criterion::benzeggagh_kenane) return work_1_ + (work_2_ - work_1_) * std::pow(mixity, p);
  return std::pow(std::pow((1 - mixity) / work_1_, p) + std::pow(mixity / work_2_, p), -1 / p);
}

double MixedModes::onset(double mixity) const {
  if (criterion_ == Criterion::none) return onset_1_;
  const double one = onset_1_ * onset_1_, two = onset_2_ * onset_2_;
  if (criterion_ == Criterion::benzeggagh_kenane) return std::sqrt(one + (two - one) * std::pow(mixity, power()));
  return 1 / std::sqrt((1 - mixity) / one + mixity / two);
}

}  // namespace tack
