#include "framework/law/bond_study.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>

#include "framework/law/bond_healing.hpp"
#include "framework/law/demands.hpp"
#include "framework/plot/axis_unit.hpp"

namespace tack {
namespace {

constexpr std::array<double, 3> directions = {0, std::numbers::pi / 4, std::numbers::pi / 2};
constexpr int coarse = 400, fine = 2000;
constexpr double little = 0.02;                     // of the peak: what pictures need not show
constexpr std::array<double, 2> turned_at = {0.6, 0.85};  // of the work: where it is unloaded
constexpr double more_work = 1.1;                   // of that done slowly, where speed begins to tell
constexpr double fastest = 1e15;                    // times the slowest that is tried

struct Parting {
  double peak = 0, at = 0;    // Pa, m
  double lets_go = 0;         // where nothing holds any more [m]; infinite: never
  double work = 0;            // J/m^2
};

double work_along(const std::vector<BondPoint>& points, double angle) {
  double work = 0;
  BondPoint before;
  for (const BondPoint& p : points) {
    work += (pull_of(p, angle) + pull_of(before, angle)) / 2 * (way_of(p) - way_of(before));
    before = p;
  }
  return work;
}

// Where it pulls most, and where it is gone, lies between two points of a curve: golden section, and halving, each time pulled anew.
void refine(const BondLaw& law, double angle, double width, Parting& parting) {
  const auto pull = [&](double x) { return pull_of(pull_bond(law, {x}, angle, coarse).back(), angle); };
  double holds = parting.lets_go - width, gone = parting.lets_go;
  for (int i = 0; i < 40 && std::isfinite(gone); ++i) (pull((holds + gone) / 2) > 0 ? holds : gone) = (holds + gone) / 2;
  parting.lets_go = gone;
  double a = std::max(parting.at - width, 1e-3 * width), b = parting.at + width;
  const double ratio = (std::sqrt(5.0) - 1) / 2;
  for (int i = 0; i < 40; ++i) {
    const double c = b - ratio * (b - a), d = a + ratio * (b - a), at_c = pull(c), at_d = pull(d);
    if (at_c > parting.peak) parting.peak = at_c, parting.at = c;
    if (at_d > parting.peak) parting.peak = at_d, parting.at = d;
    (at_c > at_d ? b : a) = at_c > at_d ? d : c;
  }
}

// With the point of the peak, which lies between two others.
Parting parting_of(const BondLaw& law, BondPath& slow) {
  Parting parting;
  for (const BondPoint& p : slow.points)
    if (pull_of(p, slow.angle) > parting.peak) parting.peak = pull_of(p, slow.angle), parting.at = way_of(p);
  parting.lets_go = std::numeric_limits<double>::infinity();
  for (auto p = slow.points.rbegin(); p != slow.points.rend() && !(pull_of(*p, slow.angle) > 0); ++p) parting.lets_go = way_of(*p);
  if (!std::isfinite(law.longest_step())) {
    refine(law, slow.angle, way_of(slow.points.front()), parting);
    BondPoint peak = pull_bond(law, {parting.at}, slow.angle, coarse).back();
    const auto next = std::find_if(slow.points.begin(), slow.points.end(), [&](const BondPoint& p) { return way_of(p) > parting.at; });
    if (next != slow.points.begin() && next != slow.points.end()) {
      peak.time = (std::prev(next)->time + next->time) / 2;
      slow.points.insert(next, peak);
    }
  }
  parting.work = work_along(slow.points, slow.angle);
  return parting;
}

double last_felt(const BondPath& path, double peak) {
  double last = 0;
  for (const BondPoint& p : path.points)
    if (pull_of(p, path.angle) > little * peak) last = way_of(p);
  return last;
}

// To where parts of its work are done and back, each time farther, and then until it is gone.
BondPath unloaded(const BondLaw& law, const BondPath& slow) {
  const double all = work_along(slow.points, slow.angle);
  std::vector<double> turns;
  double work = 0;
  BondPoint before;
  for (const BondPoint& p : slow.points) {
    work += (pull_of(p, slow.angle) + pull_of(before, slow.angle)) / 2 * (way_of(p) - way_of(before));
    before = p;
    if (turns.size() < 2 * turned_at.size() && work >= turned_at[turns.size() / 2] * all) turns.insert(turns.end(), {way_of(p), 0.0});
  }
  if (turns.empty()) turns = {slow.shown, 0};
  turns.push_back(std::max(slow.shown, turns[turns.size() - 2]));
  return {"unloading", slow.angle, 0, slow.shown, pull_bond(law, turns, slow.angle, fine)};
}

// The slowest speed at which its work is more by a tenth; 0: there is none.
double telling_speed(const BondLaw& law, double far) {
  const double slowly = work_along(pull_bond(law, {far}, 0, coarse), 0);
  const auto tells = [&](double speed) { return work_along(pull_bond(law, {far}, 0, coarse, speed), 0) > more_work * slowly; };
  double low = far * 1e-7, high = low * fastest;
  if (!tells(high)) return 0;
  for (int i = 0; i < 40; ++i) {
    const double middle = std::sqrt(low * high);
    (tells(middle) ? high : low) = middle;
  }
  return high;
}

// To one digit.
double rounded(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)));
  return std::round(value / digit) * digit;
}

// Beside the barrier, if bonds are unstressed where surfaces touch: where a new one balances it, and with how much [m, Pa]; nothing if
// the barrier pushes more than it holds, up to the opening of its peak.
std::optional<std::pair<double, double>> balance(const StudiedLaw& studied, double peak_at) {
  double low = 1e-6 * studied.contact_distance, high = std::min(peak_at, studied.contact_distance);
  const auto bond = [&](double gap) { return pull_bond(*studied.bond, {gap}, 0, coarse).back().traction; };
  const auto pull = [&](double gap) { return studied.pair.at(gap + studied.pair.offset()).slope + bond(gap); };
  if (!(pull(high) > 0)) return std::nullopt;
  for (int i = 0; i < 40; ++i) (pull((low + high) / 2) < 0 ? low : high) = (low + high) / 2;
  return std::pair(high, bond(high));
}

}  // namespace

double way_of(const BondPoint& p) { return std::hypot(p.opening, p.slip); }

double pull_of(const BondPoint& p, double angle) { return p.traction * std::cos(angle) + p.shear * std::sin(angle); }

std::string direction_name(double angle) { return angle == directions[0] ? "along the normal" : angle == directions[2] ? "across" : "at 45°"; }

BondStudy study_bond_law(const StudiedLaw& studied, const StudySettings& settings) {
  const BondLaw& law = *studied.bond;
  BondStudy study;
  auto& f = study.figures;
  std::vector<double> memory(law.width());
  law.fresh(false, memory.data());
  const BondSample fresh = law.at(0, 0, memory.data(), 0);
  f.push_back({"peak traction", law.peak_traction(), "Pa", "as it states, along the normal"});
  f.push_back({"work of adhesion", law.work_of_adhesion(), "J/m^2", "as it states, along the normal"});
  Fall fall;
  double most_held = 0;  // m
  for (const double angle : directions) {
    BondPath slow{"slow", angle, 0, 0, part_slowly(law, angle, fine)};
    if (slow.points.empty()) {
      f.push_back({"peak " + direction_name(angle), 0, "Pa", "it does not hold that way"});
      continue;
    }
    const Parting parting = parting_of(law, slow);
    slow.shown = 1.15 * last_felt(slow, parting.peak);
    const std::string direction = direction_name(angle);
    const bool ends = std::isfinite(parting.lets_go);
    f.push_back({"peak " + direction, parting.peak, "Pa", angle == directions[1] ? "in that direction" : ""});
    f.push_back({"opening of the peak " + direction, parting.at, "m"});
    f.push_back({"critical opening " + direction, parting.lets_go, "m",
                 ends ? "gone from there on" : fmt::format("it fades: a thousandth is left at {}", with_axis_unit(way_of(slow.points.back()), "m"))});
    f.push_back({"work " + direction, parting.work, "J/m^2", ends ? "of the traction over the way, until it is gone" : "of the traction over the way"});
    if (angle == 0) {
      std::vector<std::pair<double, double>> traction;
      for (const BondPoint& p : slow.points) traction.emplace_back(p.opening, p.traction);
      fall = fall_of(traction);
      most_held = parting.at;
    }
    study.slow.push_back(std::move(slow));
  }
  f.push_back({"stiffness along the normal", fresh.by_dd, "Pa/m", "of a new bond"});
  f.push_back({"stiffness across", 2 * fresh.by_s, "Pa/m", "of a new bond"});
  f.push_back({"contact distance", studied.contact_distance, "m", "where the barrier begins"});
  f.push_back({"depth of the well", law.work_of_adhesion(), "J/m^2", "of whole bonds, which are unstressed where they are made: surfaces rest there"});
  if (most_held > 0) {
    const auto at = balance(studied, most_held);
    f.push_back({"rest gap", at ? at->first : std::numeric_limits<double>::infinity(), "m",
                 at ? fmt::format("with `unstressed: touching`: the barrier and new bonds balance with {}", with_axis_unit(at->second, "Pa"))
                    : "with `unstressed: touching`: the barrier takes bonds apart; lower contact.distance, or the barrier's stiffness"});
  }
  add_demands(studied, settings, fall, f);
  if (study.slow.empty()) return study;
  if (law.width() > 0)
    for (const BondPath& slow : study.slow) study.unloading.push_back(unloaded(law, slow));
  if (study.slow.front().angle == 0) {
    const double far = way_of(study.slow.front().points.back()), telling = telling_speed(law, far);
    if (telling > 0) {
      f.push_back({"speed that tells", telling, "m/s", "at which its work is a tenth more"});
      const double first = settings.speed ? *settings.speed / 10 : rounded(telling);
      for (const double speed : {first, 10 * first, 100 * first}) study.rates.push_back({"rate", 0, speed, 0, pull_bond(law, {4 * far}, 0, 4 * fine, speed)});
      const double shown = std::max(study.slow.front().shown, 1.15 * last_felt(study.rates[1], law.peak_traction()));
      for (BondPath& rate : study.rates) rate.shown = shown;
    }
    study_healing(law, settings.pressure.value_or(law.peak_traction()), far, study.healing, f);
  }
  return study;
}

}  // namespace tack
