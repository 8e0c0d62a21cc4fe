#include "framework/checks/bond_law_check.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/bond/bond_curve.hpp"
#include "framework/bond/varying_strength.hpp"
#include "framework/checks/difference_study.hpp"

namespace tack {
namespace {

struct BondCheck {
  static constexpr double h = 1e-2;                // s
  static constexpr double tolerance = 1e-4;        // of derivatives, relative
  static constexpr double rounding = 1e-9;         // of energies, relative
  static constexpr double misstatement = 0.01;     // of the peak and the work
};

// A bond with a history, and the opening and slip that it is pulled to.
struct Pulled {
  std::vector<double> memory;
  double d, s;

  BondSample at(const BondLaw& law, double more_d, double more_s) const {
    return law.at(d * (1 + more_d), s * (1 + more_s), memory.data(), BondCheck::h);
  }
  double value(const BondLaw& law, double more_d, double more_s) const {
    const double there_d = d * (1 + more_d), there_s = s * (1 + more_s);
    double value = 0;
    law.add_values(1, &there_d, &there_s, memory.data(), BondCheck::h, &value);
    return value;
  }
};

// Openings and slips from a thirtieth to ten times the range of the law.
std::vector<Pulled> pulled_places(const BondLaw& law) {
  const double scale = law.work_of_adhesion() / law.peak_traction();
  std::vector<Pulled> all;
  for (const double past : {0.0, 0.4, 1.1, 2.3})
    for (const double past_angle : {0.0, 0.7, 1.5}) {
      std::vector<double> memory(law.width());
      law.initialize(false, memory.data());
      const double d = past * scale * std::cos(past_angle), u = past * scale * std::sin(past_angle);
      if (past > 0 && law.advance(law.assumed_state(d, u * u, BondCheck::h), memory.data()).gone) continue;
      for (const double way : {0.031, 0.13, 0.52, 0.87, 1.7, 3.1, 9.7})
        for (const double angle : {0.2, 0.8, 1.4}) {
          const double slip = way * scale * std::sin(angle);
          all.push_back({memory, way * scale * std::cos(angle), slip * slip});
        }
    }
  return all;
}

enum class Of { values, tractions };

// Derivatives by ln d and ln s, which have equal units; two or four per point.
VecX quotients(const BondLaw& law, const std::vector<Pulled>& all, Of of, double step) {
  const int n = of == Of::values ? 2 : 4;
  VecX found(n * all.size());
  for (size_t i = 0; i < all.size(); ++i) {
    const Pulled& p = all[i];
    for (int k = 0; k < 2; ++k) {
      const double d = k == 0 ? step : 0, s = k == 0 ? 0 : step;
      if (of == Of::values) {
        found(n * i + k) = (p.value(law, d, s) - p.value(law, -d, -s)) / (2 * step);
      } else {
        const BondSample high = p.at(law, d, s), low = p.at(law, -d, -s);
        found(n * i + 2 * k) = (high.by_d - low.by_d) / (2 * step) * p.d;
        found(n * i + 2 * k + 1) = (high.by_s - low.by_s) / (2 * step) * p.s;
      }
    }
  }
  return found;
}

void stated(const BondLaw& law, const std::vector<Pulled>& all, Of of, VecX& derivatives, VecX& scales) {
  const int n = of == Of::values ? 2 : 4;
  derivatives.resize(n * all.size());
  scales.resize(n * all.size());
  for (size_t i = 0; i < all.size(); ++i) {
    const Pulled& p = all[i];
    const BondSample s = p.at(law, 0, 0);
    const double first = std::abs(s.by_d * p.d) + std::abs(s.by_s * p.s);
    const double second = std::abs(s.by_dd * p.d * p.d) + std::abs(s.by_ds * p.d * p.s) + std::abs(s.by_ss * p.s * p.s);
    if (of == Of::values)
      derivatives.segment<2>(n * i) = Vec2(s.by_d * p.d, s.by_s * p.s);
    else
      derivatives.segment<4>(n * i) << s.by_dd * p.d * p.d, s.by_ds * p.d * p.s, s.by_ds * p.d * p.s, s.by_ss * p.s * p.s;
    scales.segment(n * i, n).setConstant(first + (of == Of::values ? std::abs(s.value) : second) + 1e-6 * law.work_of_adhesion());
  }
}

void check_derivatives(const BondLaw& law, const std::vector<Pulled>& all, Of of, const char* what, LawCheck& check) {
  VecX derivatives, scales;
  stated(law, all, of, derivatives, scales);
  std::vector<VecX> errors;
  double step = DifferenceStudy::first_step;
  for (int k = 0; k < DifferenceStudy::steps; ++k, step /= DifferenceStudy::ratio) errors.push_back(quotients(law, all, of, step) - derivatives);
  if (const DifferenceStudy study = study_differences(errors, scales, BondCheck::tolerance); study.wrong)
    check.errors.emplace_back(WarningKind::law_derivatives, fmt::format("{}: {}, off by {:.1e} of it", law.type(), what, study.error));
}

// Dissipation by viscosity appears in the potential by half.
void check_energy(const BondLaw& law, const std::vector<Pulled>& all, LawCheck& check) {
  double worst = 0, taken_there = 0, booked_there = 0;
  for (const Pulled& p : all) {
    std::vector<double> memory = p.memory;
    const BondChange change = law.advance(law.assumed_state(p.d, p.s, BondCheck::h), memory.data());
    const double value = p.value(law, 0, 0), taken = value - (change.gone ? 0 : law.stored(p.d, p.s, memory.data()));
    const double off = std::max(taken - change.dissipated, change.dissipated - 2 * taken) / (std::abs(value) + law.work_of_adhesion());
    if (off > worst) worst = off, taken_there = taken, booked_there = change.dissipated;
  }
  if (worst <= BondCheck::rounding) return;
  check.errors.emplace_back(WarningKind::law_dissipation, fmt::format("{}: a step takes {:.4g} J/m^2 from its potential that are not stored afterwards, and {:.4g} J/m^2 are booked as dissipated: its memory "
                                    "after a step, and its loss, have to be those of the least that its energy is", law.type(), taken_there, booked_there));
}

void check_statements(const BondLaw& law, LawCheck& check) {
  std::vector<double> memory(law.width());
  law.initialize(false, memory.data());
  if (law.intensity_of(memory.data()) < 1 || dynamic_cast<const VaryingStrength*>(&law)) return;
  double peak = 0, work = 0;
  BondPoint before;
  for (const BondPoint& p : separate_slowly(law)) {
    peak = std::max(peak, p.traction);
    work += (p.traction + before.traction) / 2 * (p.opening - before.opening);
    before = p;
  }
  const auto compare = [&](const char* what, const char* unit, double stated_value, double found) {
    if (std::abs(found - stated_value) <= BondCheck::misstatement * stated_value) return;
    check.warnings.emplace_back(WarningKind::law_statement, fmt::format("{}: states a {} of {:.4g} {}, and has {:.4g} when it is pulled slowly; reports and the default stiffness of barriers go by "
                                         "what it states", law.type(), what, stated_value, unit, found));
  };
  compare("peak traction", "Pa", law.peak_traction(), peak);
  compare("work of adhesion", "J/m^2", law.work_of_adhesion(), work);
}

}  // namespace

LawCheck check_law(const BondLaw& law) {
  LawCheck check;
  if (!(law.peak_traction() > 0 && law.work_of_adhesion() > 0)) return check;  // nothing to go by
  const std::vector<Pulled> all = pulled_places(law);
  for (const Pulled& p : all) {
    const BondSample s = p.at(law, 0, 0);
    if (std::isfinite(s.value + s.by_d + s.by_s + s.by_dd + s.by_ds + s.by_ss)) continue;
    check.errors.emplace_back(WarningKind::law_not_finite, fmt::format("{}: its values or derivatives are not finite at an opening of {:.4g} m and a slip of {:.4g} m", law.type(), p.d, std::sqrt(p.s)));
    return check;
  }
  check_derivatives(law, all, Of::values, "its tractions are not the derivatives of its energy", check);
  check_derivatives(law, all, Of::tractions, "its second derivatives are not those of its tractions", check);
  check_energy(law, all, check);
  check_statements(law, check);
  return check;
}

}  // namespace tack
