#include "framework/checks/law_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/bond/bond_term.hpp"
#include "framework/checks/bond_law_check.hpp"
#include "framework/checks/difference_study.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/contact/laws/law_peak.hpp"
#include "framework/world/world.hpp"

namespace tack {
namespace {

constexpr int samples = 400;              // in the range
constexpr double tolerance = 1e-4;       // of derivatives, relative
constexpr double largest_jump = 1e-3;    // of the largest traction and of the largest energy
constexpr double largest_misstatement = 0.01;
constexpr double least_felt = 0.97;      // of the stated peak, with the barrier against it

class Sampled {
 public:
  explicit Sampled(const NormalLaw& law) : law_(law), gaps_(samples) {
    for (int i = 0; i < samples; ++i) {
      gaps_(i) = law.range() * (i + 0.5) / samples;
      samples_.push_back(law.at(gaps_(i)));
    }
  }

  // The gap with the largest error, if slopes (or curvatures) contradict values (or slopes).
  DifferenceStudy study(bool of_slopes, double& worst) const {
    std::vector<VecX> errors;
    double step = DifferenceStudy::first_step;
    for (int k = 0; k < DifferenceStudy::steps; ++k, step /= DifferenceStudy::ratio) errors.push_back(errors_at(step, of_slopes));
    const VecX scales = scales_of(of_slopes);
    const DifferenceStudy study = study_differences(errors, scales, tolerance);
    Eigen::Index at = 0;
    (errors[6].array() / scales.array().max(1e-300)).abs().maxCoeff(&at);
    worst = gaps_(at);
    return study;
  }
  double largest_slope() const {
    double largest = 0;
    for (const LawSample& s : samples_) largest = std::max(largest, std::abs(s.slope));
    return largest;
  }
  double largest_value() const {
    double largest = 0;
    for (const LawSample& s : samples_) largest = std::max(largest, std::abs(s.value));
    return largest;
  }
  bool finite() const {
    return std::all_of(samples_.begin(), samples_.end(), [](const LawSample& s) { return std::isfinite(s.value) && std::isfinite(s.slope) && std::isfinite(s.curvature); });
  }

 private:
  VecX errors_at(double step, bool of_slopes) const {
    VecX errors(samples);
    for (int i = 0; i < samples; ++i) {
      const double h = step * gaps_(i), up = gaps_(i) + h, down = gaps_(i) - h;
      if (of_slopes) {
        errors(i) = (law_.at(up).slope - law_.at(down).slope) / (up - down) - samples_[i].curvature;
      } else {
        double values[2] = {0, 0};
        const double at[2] = {up, down};
        law_.add_values(2, at, values);
        errors(i) = (values[0] - values[1]) / (up - down) - samples_[i].slope;
      }
    }
    return errors;
  }
  VecX scales_of(bool of_slopes) const {
    VecX scales(samples);
    for (int i = 0; i < samples; ++i) {
      const LawSample& s = samples_[i];
      scales(i) = of_slopes ? std::abs(s.curvature) + std::abs(s.slope) / gaps_(i) : std::abs(s.slope) + std::abs(s.value) / gaps_(i);
    }
    return scales;
  }

  const NormalLaw& law_;
  VecX gaps_;  // m
  std::vector<LawSample> samples_;
};

void check_end(const NormalLaw& law, const Sampled& sampled, LawCheck& check) {
  const LawSample end = law.at(law.range() * (1 - 1e-9));
  const double slope = std::abs(end.slope) / sampled.largest_slope(), value = std::abs(end.value) / sampled.largest_value();
  if (slope > largest_jump)
    check.warnings.emplace_back(WarningKind::law_traction_jump, fmt::format("{}: its traction jumps from {:.4g} Pa to 0 at its range, {:.4g} m ({:.2g}% of the largest): steps beside it do not "
                                         "converge, and the jump does work; let it fall to 0, or state a longer range", law.name(), end.slope, law.range(), 100 * slope));
  if (value > largest_jump)
    check.warnings.emplace_back(WarningKind::law_energy_jump, fmt::format("{}: its energy jumps from {:.4g} J/m^2 to 0 at its range, {:.4g} m ({:.2g}% of the largest): whoever comes or goes there "
                                         "gains or loses that; subtract its value at the range, or state a longer range", law.name(), end.value, law.range(), 100 * value));
}

void check_statements(const NormalAdhesion& law, LawCheck& check) {
  const auto compare = [&](const char* what, const char* unit, double stated, double found) {
    if (std::abs(stated - found) <= largest_misstatement * std::max(std::abs(stated), std::abs(found))) return;
    check.warnings.emplace_back(WarningKind::law_statement, fmt::format("{}: states {} of {:.4g} {}, and has {:.4g}; reports and tangential adhesion go by what it states", law.name(), what, stated,
                                         unit, found));
  };
  compare("a peak traction", "Pa", law.peak_traction(), largest_traction(law).traction);
  // The work to infinity: a jump of the energy at the range is no work of the traction.
  compare("a work of adhesion", "J/m^2", law.work_of_adhesion(), law.at(law.range() * (1 - 1e-9)).value - law.at(law.range() * 1e-9).value);
}

// Checks whether the barrier of a pair leaves the peak of its adhesion.
void check_peak(const NormalAdhesion& law, const PairLaw& pair, LawCheck& check) {
  double contact_distance = 0, felt = 0;
  for (const auto& part : pair.laws())
    if (dynamic_cast<const BarrierLaw*>(part.get())) contact_distance = std::max(contact_distance, part->range());
  const auto [at, peak] = largest_traction(law);
  if (at >= contact_distance) return;
  for (int i = 0; i < samples; ++i) felt = std::max(felt, pair.at(pair.offset() + law.range() * (i + 0.5) / samples).slope);
  if (felt >= least_felt * peak) return;
  check.warnings.emplace_back(WarningKind::law_peak_in_barrier, fmt::format("{}: its traction peaks at {:.4g} m, within the contact distance of {:.4g} m, where the barrier pushes: surfaces feel {:.4g} of "
                                       "{:.4g} Pa; move the peak out, or lower contact.distance", law.name(), at, contact_distance, felt, peak));
}

void append(LawCheck& check, const LawCheck& more) {
  check.errors.insert(check.errors.end(), more.errors.begin(), more.errors.end());
  check.warnings.insert(check.warnings.end(), more.warnings.begin(), more.warnings.end());
  check.notes.insert(check.notes.end(), more.notes.begin(), more.notes.end());
}

std::string of_pair(const std::string& names, const std::string& line) { return fmt::format("law of {}: {}", names, line); }

void add(std::vector<Warning>& list, const std::vector<Warning>& more, const std::string& names) {
  for (const Warning& warning : more) list.emplace_back(warning.kind, of_pair(names, warning.text));
}

}  // namespace

LawCheck check_law(const NormalLaw& law) {
  LawCheck check;
  const Sampled sampled(law);
  if (!sampled.finite()) {
    check.errors.emplace_back(WarningKind::law_not_finite, fmt::format("{}: its values or derivatives are not finite everywhere within its range of {:.4g} m", law.name(), law.range()));
    return check;
  }
  double at = 0;
  if (const auto study = sampled.study(false, at); study.wrong)
    check.errors.emplace_back(WarningKind::law_derivatives, fmt::format("{}: its traction is not the derivative of its energy, off by {:.1e} of it, most at {:.4g} m", law.name(), study.error, at));
  if (const auto study = sampled.study(true, at); study.wrong)
    check.errors.emplace_back(WarningKind::law_derivatives, fmt::format("{}: its curvature is not the derivative of its traction, off by {:.1e} of it, most at {:.4g} m", law.name(), study.error, at));
  check_end(law, sampled, check);
  if (const auto* adhesion = dynamic_cast<const NormalAdhesion*>(&law)) {
    check_statements(*adhesion, check);
    for (const std::string& doubt : adhesion->warnings()) check.warnings.emplace_back(WarningKind::law_data, doubt);
    if (const std::string note = adhesion->note(); !note.empty()) check.notes.push_back(note);
  }
  return check;
}

LawCheck check_pair(const PairLaw& pair) {
  LawCheck all;
  for (const auto& part : pair.laws()) {
    LawCheck check = check_law(*part);
    if (const auto* adhesion = dynamic_cast<const NormalAdhesion*>(part.get())) check_peak(*adhesion, pair, check);
    append(all, check);
  }
  return all;
}

LawCheck check_laws(const World& world) {
  LawCheck all;
  for (const AdhesionSummary& pair : world.adhesion) {
    const PairTable& table = world.contact->pairs();
    const auto& [a, b] = pair.kinds.front();
    LawCheck check = check_pair(table.laws()[table.codimensional(a, b, pair.region_pair).law]);
    if (const int rule = world.bonds ? world.bonds->table().between(a, b, pair.region_pair) : -1; rule >= 0) {
      const BondLaw& law = *world.bonds->table().rules()[rule].law;
      append(check, check_law(law));
      for (const std::string& doubt : law.warnings()) check.warnings.emplace_back(WarningKind::law_data, doubt);
      if (const std::string note = law.note(); !note.empty()) check.notes.push_back(note);
    }
    add(all.errors, check.errors, pair.names());
    add(all.warnings, check.warnings, pair.names());
    for (const std::string& note : check.notes) all.notes.push_back(of_pair(pair.names(), note));
  }
  return all;
}

}  // namespace tack
