#include "framework/law/gap_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "framework/contact/laws/law_peak.hpp"
#include "framework/law/scene_requirements.hpp"
#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr int near_points = 1000, far_points = 200;
constexpr double hidden_gap_traction = 0.01;  // of the peak: plots may omit smaller tractions
constexpr double on_plateau = 0.999;

double traction_at(const NormalLaw& law, double gap) { return law.at(gap).slope; }

// Integrates the traction from zero gap to the range [J/m^2], by three-point Gauss quadrature on
// equal intervals.
double integrated_work(const NormalLaw& law) {
  constexpr int intervals = 20000;
  const double width = law.range() / intervals, off = std::sqrt(0.15);
  double sum = 0;
  for (int i = 0; i < intervals; ++i) {
    const double middle = width * (i + 0.5);
    sum += width * (5 * traction_at(law, middle - off * width) + 8 * traction_at(law, middle) + 5 * traction_at(law, middle + off * width)) / 18;
  }
  return sum;
}

GapPoint point_at(const StudiedLaw& studied, double gap) {
  const LawSample adhesion = studied.gap->at(gap), pair = studied.pair.at(gap + studied.pair.offset());
  return {gap, adhesion.slope, adhesion.value, pair.slope, pair.value};
}

}  // namespace

GapStudy study_gap_law(const StudiedLaw& studied, const StudySettings& settings) {
  const NormalAdhesion& law = *studied.gap;
  const LawPeak peak = largest_traction(law);
  GapStudy study;
  const double last_shown = last_gap_with(law, hidden_gap_traction * peak.traction), end = 1.02 * law.range();
  study.shown = std::min(1.1 * last_shown, end);
  for (int i = 1; i <= near_points; ++i) study.curve.push_back(point_at(studied, study.shown * i / near_points));
  for (int i = 1; i <= far_points && end > study.shown; ++i) study.curve.push_back(point_at(studied, study.shown + (end - study.shown) * i / far_points));
  study.curve.push_back(point_at(studied, peak.gap));
  std::sort(study.curve.begin(), study.curve.end(), [](const GapPoint& a, const GapPoint& b) { return a.gap < b.gap; });

  std::vector<std::pair<double, double>> traction;
  for (const GapPoint& p : study.curve) traction.emplace_back(p.gap, p.traction);
  const SofteningRange softening = softening_range(traction);
  auto& f = study.quantities;
  const double plateau = last_gap_with(law, on_plateau * peak.traction);
  f = {{"peak traction", peak.traction, "Pa", fmt::format("largest on the curve; the law states {}", with_axis_unit(law.peak_traction(), "Pa"))},
       {"gap of the peak", peak.gap, "m", plateau > 1.5 * peak.gap ? fmt::format("a plateau up to {}", with_axis_unit(plateau, "m")) : ""},
       {"gap of a tenth of the peak", softening.to, "m", "beyond the peak"},
       {"range", law.range(), "m", "no adhesion beyond"},
       {"work of adhesion", law.work_of_adhesion(), "J/m^2", "stated by the law"},
       {"work integrated", integrated_work(law), "J/m^2", "integral of the traction over the gap"}};
  const PairLaw::Well well = studied.pair.well();
  f.push_back({"contact distance", studied.contact_distance, "m", "where the barrier begins"});
  f.push_back({"depth of the well", well.depth, "J/m^2",
               fmt::format("with the barrier, which takes {:.2g}% of the work", 100 * (1 - well.depth / law.work_of_adhesion()))});
  f.push_back({"rest gap", well.gap, "m", "equilibrium without load"});
  add_scene_requirements(studied, settings, softening, {}, f);
  return study;
}

}  // namespace tack
