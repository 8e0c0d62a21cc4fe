#include "framework/law/bond_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/law/bond_healing.hpp"
#include "framework/law/scene_requirements.hpp"
#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr std::array<double, 3> directions = {0, std::numbers::pi / 4, std::numbers::pi / 2};
constexpr int coarse = 400, fine = 2000;
constexpr double hidden_bond_traction = 0.02;  // of the peak: plots may omit smaller tractions
constexpr std::array<double, 2> unloading_work = {0.6, 0.85};  // of the whole work: where the bond is unloaded

// Metrics of quasi-static opening in one direction.
struct OpeningMetrics {
  double peak = 0, peak_opening = 0;  // Pa, m
  double critical_opening = 0;        // opening beyond which the traction is zero [m]; infinite: none
  double work = 0;                    // J/m^2
};

double work_along(const std::vector<BondPoint>& points, double angle) {
  double work = 0;
  BondPoint before;
  for (const BondPoint& p : points) {
    work += (traction_along(p, angle) + traction_along(before, angle)) / 2 * (displacement_of(p) - displacement_of(before));
    before = p;
  }
  return work;
}

// Refines the peak (golden section) and the critical opening (bisection) between the points of a
// curve with spacing `width` [m]. Each evaluation opens a new bond.
void refine(const BondLaw& law, double angle, double width, OpeningMetrics& metrics) {
  const auto traction_at = [&](double x) { return traction_along(pull_bond(law, {x}, angle, coarse).back(), angle); };
  double intact = metrics.critical_opening - width, failed = metrics.critical_opening;
  for (int i = 0; i < 40 && std::isfinite(failed); ++i) (traction_at((intact + failed) / 2) > 0 ? intact : failed) = (intact + failed) / 2;
  metrics.critical_opening = failed;
  double a = std::max(metrics.peak_opening - width, 1e-3 * width), b = metrics.peak_opening + width;
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 40; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a), at_c = traction_at(c), at_d = traction_at(d);
    if (at_c > metrics.peak) metrics.peak = at_c, metrics.peak_opening = c;
    if (at_d > metrics.peak) metrics.peak = at_d, metrics.peak_opening = d;
    (at_c > at_d ? b : a) = at_c > at_d ? d : c;
  }
}

// Returns the metrics of a quasi-static path, and inserts the point of the peak into the path.
OpeningMetrics opening_metrics(const BondLaw& law, BondPath& slow) {
  OpeningMetrics metrics;
  for (const BondPoint& p : slow.points)
    if (traction_along(p, slow.angle) > metrics.peak) metrics.peak = traction_along(p, slow.angle), metrics.peak_opening = displacement_of(p);
  metrics.critical_opening = std::numeric_limits<double>::infinity();
  for (auto p = slow.points.rbegin(); p != slow.points.rend() && !(traction_along(*p, slow.angle) > 0); ++p) metrics.critical_opening = displacement_of(*p);
  if (!std::isfinite(law.longest_step())) {
    refine(law, slow.angle, displacement_of(slow.points.front()), metrics);
    BondPoint peak = pull_bond(law, {metrics.peak_opening}, slow.angle, coarse).back();
    const auto next = std::find_if(slow.points.begin(), slow.points.end(), [&](const BondPoint& p) { return displacement_of(p) > metrics.peak_opening; });
    if (next != slow.points.begin() && next != slow.points.end()) {
      peak.time = (std::prev(next)->time + next->time) / 2;
      slow.points.insert(next, peak);
    }
  }
  metrics.work = work_along(slow.points, slow.angle);
  return metrics;
}

// Returns the last displacement [m] with a traction that plots show.
double last_shown_displacement(const BondPath& path, double peak) {
  double last = 0;
  for (const BondPoint& p : path.points)
    if (traction_along(p, path.angle) > hidden_bond_traction * peak) last = displacement_of(p);
  return last;
}

// Returns the path with unloading to zero displacement after each fraction `unloading_work` of the
// whole work, then loading until the bond has failed.
BondPath unloading_path(const BondLaw& law, const BondPath& slow) {
  const double all = work_along(slow.points, slow.angle);
  std::vector<double> turns;
  double work = 0;
  BondPoint before;
  for (const BondPoint& p : slow.points) {
    work += (traction_along(p, slow.angle) + traction_along(before, slow.angle)) / 2 * (displacement_of(p) - displacement_of(before));
    before = p;
    if (turns.size() < 2 * unloading_work.size() && work >= unloading_work[turns.size() / 2] * all) turns.insert(turns.end(), {displacement_of(p), 0.0});
  }
  if (turns.empty()) turns = {slow.shown, 0};
  turns.push_back(std::max(slow.shown, turns[turns.size() - 2]));
  return {"unloading", slow.angle, 0, slow.shown, pull_bond(law, turns, slow.angle, fine)};
}

// Rounds to one digit.
double rounded(double value) {
  if (!(value > 0)) return 0;
  const double digit = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / digit) * digit;
}

// Returns the softening range of opening along the normal at a speed [m/s]. opening_end: of slow
// failure [m].
SofteningRange softening_at(const BondLaw& law, double opening_end, double speed) {
  std::vector<std::pair<double, double>> traction;
  for (const BondPoint& p : pull_bond(law, {4 * opening_end}, 0, 4 * fine, speed)) traction.emplace_back(p.opening, p.traction);
  return softening_range(traction);
}

// Returns the three speeds of curves [m/s]: around the chosen one; else from that of the first rate
// effect to beyond the largest one; none for a law that does not depend on the rate.
std::vector<double> drawn_speeds(const RateScan& scan, const std::optional<double>& chosen) {
  if (chosen) return {*chosen / 10, *chosen, *chosen * 10};
  if (!scan.rate_dependent()) return {};
  const double first = rounded(scan.effect_speed), largest = rounded(scan.largest_speed);
  if (largest > 2 * first) return {first, largest, rounded(largest * largest / first)};
  return {first, 10 * first, 100 * first};
}

// Equilibrium of the barrier with a new bond that is unstressed at zero gap.
struct BarrierBalance {
  double gap, traction;  // m; of the bond [Pa]
};

// Returns the equilibrium; nothing if the barrier exceeds the traction of the bond at all openings
// up to that of its peak.
std::optional<BarrierBalance> barrier_balance(const StudiedLaw& studied, double peak_opening) {
  double low = 1e-6 * studied.contact_distance, high = std::min(peak_opening, studied.contact_distance);
  const auto bond = [&](double gap) { return pull_bond(*studied.bond, {gap}, 0, coarse).back().traction; };
  const auto net = [&](double gap) { return studied.pair.at(gap + studied.pair.offset()).slope + bond(gap); };
  if (!(net(high) > 0)) return std::nullopt;
  for (int i = 0; i < 40; ++i) (net((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return BarrierBalance{high, bond(high)};
}

}  // namespace

double displacement_of(const BondPoint& p) { return std::hypot(p.opening, p.slip); }

double traction_along(const BondPoint& p, double angle) { return p.traction * std::cos(angle) + p.shear * std::sin(angle); }

std::string direction_name(double angle) { return angle == directions[0] ? "along the normal" : angle == directions[2] ? "across" : "at 45°"; }

BondStudy study_bond_law(const StudiedLaw& studied, const StudySettings& settings) {
  const BondLaw& law = *studied.bond;
  BondStudy study;
  auto& f = study.quantities;
  std::vector<double> history(law.width());
  law.initialize(false, history.data());
  const BondSample new_bond = law.at(0, 0, history.data(), 0);
  f.push_back({"peak traction", law.peak_traction(), "Pa", "stated by the law, along the normal"});
  f.push_back({"work of adhesion", law.work_of_adhesion(), "J/m^2", "stated by the law, along the normal"});
  if (law.depends_on_temperature()) f.push_back({"temperature", law.assumed_site().temperature, "K", "of the quantities below"});
  SofteningRange softening, fast_softening;
  double normal_peak_opening = 0;  // m
  for (const double angle : directions) {
    BondPath slow{"slow", angle, 0, 0, separate_slowly(law, angle, fine)};
    if (slow.points.empty()) {
      f.push_back({"peak " + direction_name(angle), 0, "Pa", "no traction in this direction"});
      continue;
    }
    const OpeningMetrics metrics = opening_metrics(law, slow);
    slow.shown = 1.15 * last_shown_displacement(slow, metrics.peak);
    const std::string direction = direction_name(angle);
    const bool ends = std::isfinite(metrics.critical_opening);
    f.push_back({"peak " + direction, metrics.peak, "Pa", angle == directions[1] ? "in that direction" : ""});
    f.push_back({"opening of the peak " + direction, metrics.peak_opening, "m"});
    f.push_back({"critical opening " + direction, metrics.critical_opening, "m",
                 ends ? "no traction beyond" : fmt::format("asymptotic: a thousandth of the traction is left at {}", with_axis_unit(displacement_of(slow.points.back()), "m"))});
    f.push_back({"work " + direction, metrics.work, "J/m^2", ends ? "integral of the traction up to the critical opening" : "integral of the traction"});
    if (angle == 0) {
      std::vector<std::pair<double, double>> traction;
      for (const BondPoint& p : slow.points) traction.emplace_back(p.opening, p.traction);
      softening = softening_range(traction);
      if (settings.speed) fast_softening = softening_at(law, displacement_of(slow.points.back()), *settings.speed);
      normal_peak_opening = metrics.peak_opening;
    }
    study.slow.push_back(std::move(slow));
  }
  f.push_back({"stiffness along the normal", new_bond.by_dd, "Pa/m", "of a new bond"});
  f.push_back({"stiffness across", 2 * new_bond.by_s, "Pa/m", "of a new bond"});
  f.push_back({"contact distance", studied.contact_distance, "m", "where the barrier begins"});
  f.push_back({"depth of the well", law.work_of_adhesion(), "J/m^2", "of intact bonds, which are unstressed where they form: surfaces rest there"});
  if (normal_peak_opening > 0) {
    const auto at = barrier_balance(studied, normal_peak_opening);
    f.push_back({"rest gap", at ? at->gap : std::numeric_limits<double>::infinity(), "m",
                 at ? fmt::format("with `unstressed: touching`: the barrier balances new bonds at {}", with_axis_unit(at->traction, "Pa"))
                    : "with `unstressed: touching`: the barrier breaks the bonds; lower contact.distance, or the barrier's stiffness"});
  }
  add_scene_requirements(studied, settings, softening, fast_softening, f);
  if (study.slow.empty()) return study;
  if (law.width() > 0)
    for (const BondPath& slow : study.slow) study.unloading.push_back(unloading_path(law, slow));
  const BondPath& slow = study.slow.front();
  const double opening_end = displacement_of(slow.points.back());
  study.scan = scan_rates(law, slow.angle, opening_end, f);
  for (const double speed : drawn_speeds(study.scan, settings.speed))
    study.rates.push_back({"rate", slow.angle, speed, 0, pull_bond(law, {4 * opening_end}, slow.angle, 4 * fine, speed)});
  if (!study.rates.empty()) {
    const double shown = std::max(slow.shown, 1.15 * last_shown_displacement(study.rates[1], law.peak_traction()));
    for (BondPath& rate : study.rates) rate.shown = shown;
  }
  if (slow.angle == 0) study_healing(law, settings.pressure.value_or(law.peak_traction()), opening_end, study.healing, f);
  return study;
}

}  // namespace tack
