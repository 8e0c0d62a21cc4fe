#include "framework/stepping/lagged_impulses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tack {
namespace {

constexpr double calm_change = 0.25;  // by less than that part of the larger one, forces change where a contact lasts
constexpr double short_while = 2, long_while = 4;  // of the next step: for how long it has lasted where s is 1, and 0
constexpr double for_ever = 1e30;     // s
constexpr double alike = 1e-9;        // the part by which forces of steps that are alike may differ
constexpr double too_much = 0.1;      // of the normal impulse
constexpr double settled = 0.01;      // the part by which forces may change from solve to solve
constexpr int most_solves = 10;       // of a step

}  // namespace

LaggedImpulses::LaggedImpulses(FrictionTerm& friction, std::vector<double> masses, double tolerance)
    : friction_(friction), masses_(std::move(masses)), tolerance_(tolerance) {}

// The impulse between two objects that velocities do not notice [N s].
double LaggedImpulses::unnoticed(const std::array<int, 2>& objects) const {
  double mass = std::numeric_limits<double>::infinity();
  for (const int o : objects)
    if (masses_[o] > 0) mass = std::min(mass, masses_[o]);
  return tolerance_ * mass;
}

void LaggedImpulses::begin(const State& state, double h, double acting) {
  FrictionAccounts before = accounts_of(state.history);
  const bool first = state.h_before == 0 || state.contact_time_before == 0;
  acting_ = acting;
  kept_ = 1 - acting / h;
  accounts_.clear();
  carried_.clear();
  difference_.reset();
  solves_ = 0;
  FrictionTerm::PairForces factors;
  for (const auto& [objects, force] : friction_.normal_forces()) {
    if (force == 0) continue;
    FrictionAccount& account = accounts_[objects];
    if (first) {
      account = {.normal = h * force, .given = h * force, .calm_force = force, .calm_time = for_ever, .settling = true};
      account.all_given = account.given;
      carried_[objects] = 0;
      continue;
    }
    account = before[objects];
    const double normal = (1 - state.contact_time_before / state.h_before) * account.normal + state.contact_time_before * force;
    const double due = account.owed + normal, lasting = normal * h / state.h_before, carried = kept_ * account.given;
    const bool calm = std::abs(force - account.calm_force) < calm_change * std::max(force, account.calm_force);
    if (!calm) account.calm_force = force;
    account.calm_time = calm ? account.calm_time + state.h_before : 0;
    const double s = std::clamp((long_while - account.calm_time / h) / (long_while - short_while), 0.0, 1.0);
    double held = std::max((lasting + s * (due - lasting) - carried) / acting, 0.0);
    if (std::abs(held - force) <= alike * force) held = force;
    else factors[objects] = held / force;
    carried_[objects] = carried;
    account.given = carried + acting * held;
    account.owed = due - account.given;
    account.normal = normal;
    account.all_given += account.given;
    account.all_normal += normal;
    account.largest = std::max(account.largest, normal);
  }
  if (!factors.empty()) friction_.scale_normal_forces(factors);
}

bool LaggedImpulses::settle(const ContactPoints& now) {
  const FrictionTerm::PairForces forces = friction_.normal_forces(now);
  ++solves_;
  std::set<std::array<int, 2>> settling;
  bool again = false;
  for (auto& [objects, account] : accounts_) {
    if (!account.settling) continue;
    const auto found = forces.find(objects);
    const double normal = acting_ * (found == forces.end() ? 0 : found->second), held = account.given - carried_[objects];
    const double change = std::abs(held - normal);
    const bool small = change <= unnoticed(objects);
    if (solves_ == 1 && (small || held <= (1 + too_much) * normal)) {
      account.settling = false;
      continue;
    }
    settling.insert(objects);
    again = again || (!small && change > settled * std::max(held, normal));
  }
  if (!again || solves_ == most_solves) {
    compare(forces);
    return false;
  }
  friction_.hold(now, settling);
  for (const auto& objects : settling) {
    const auto found = forces.find(objects);
    FrictionAccount& account = accounts_[objects];
    account.all_given -= account.given;
    account.given = carried_[objects] + acting_ * (found == forces.end() ? 0 : found->second);
    account.all_given += account.given;
    account.owed = 0;
  }
  return true;
}

void LaggedImpulses::compare(const FrictionTerm::PairForces& forces) {
  for (auto& [objects, account] : accounts_) {
    const auto found = forces.find(objects);
    const double last = kept_ * account.normal + acting_ * (found == forces.end() ? 0 : found->second);
    const double all = account.all_normal + last;
    const double noticed = too_much * all + std::max(account.largest, last) + unnoticed(objects);
    const bool differs = account.all_given > all + noticed || account.all_given < account.all_normal - noticed;
    if (!differs || account.told) continue;
    account.told = true;
    const int others = difference_ ? difference_->others + 1 : 0;
    const bool most = !difference_ || std::abs(account.all_given - all) > std::abs(difference_->given - difference_->normal);
    if (most) difference_ = {objects, account.all_given, all, 0};
    difference_->others = others;
  }
}

}  // namespace tack
