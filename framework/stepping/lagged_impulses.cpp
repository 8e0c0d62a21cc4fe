#include "framework/stepping/lagged_impulses.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace tack {
namespace {

constexpr double steady_change = 0.25;  // largest change of a steady force, over the larger force
constexpr double steps_of_passing = 2, steps_of_lasting = 4;  // steady times, in next steps, at which s is 1 and 0
constexpr double infinite_time = 1e30;  // s
constexpr double round_off = 1e-9;      // relative difference of forces that count as equal
constexpr double excess_max = 0.1;      // tolerated excess, over the normal impulse
constexpr double change_max = 0.01;     // tolerated change of forces from solve to solve, relative
constexpr int max_solves = 10;          // of a step

}  // namespace

LaggedImpulses::LaggedImpulses(FrictionTerm& friction, std::vector<double> masses, double tolerance)
    : friction_(friction), masses_(std::move(masses)), tolerance_(tolerance) {}

double LaggedImpulses::impulse_tolerance(const std::array<int, 2>& objects) const {
  double mass = std::numeric_limits<double>::infinity();
  for (const int o : objects)
    if (masses_[o] > 0) mass = std::min(mass, masses_[o]);
  return tolerance_ * mass;
}

void LaggedImpulses::begin(const State& state, double h, double contact_time) {
  FrictionAccounts before = accounts_of(state.history);
  const bool first = state.h_before == 0 || state.contact_time_before == 0;
  contact_time_ = contact_time;
  kept_fraction_ = 1 - contact_time / h;
  accounts_.clear();
  kept_impulses_.clear();
  difference_.reset();
  solves_ = 0;
  FrictionTerm::PairForces factors;
  for (const auto& [objects, force] : friction_.normal_forces()) {
    if (force == 0) continue;
    FrictionAccount& account = accounts_[objects];
    if (first) {
      account = {.normal = h * force, .applied = h * force, .steady_force = force, .steady_time = infinite_time, .start_up = true};
      account.sum_applied = account.applied;
      kept_impulses_[objects] = 0;
      continue;
    }
    account = before[objects];
    const double normal = (1 - state.contact_time_before / state.h_before) * account.normal + state.contact_time_before * force;
    const double target = account.impulse_error + normal, lasting = normal * h / state.h_before, kept_impulse = kept_fraction_ * account.applied;
    const bool steady = std::abs(force - account.steady_force) < steady_change * std::max(force, account.steady_force);
    if (!steady) account.steady_force = force;
    account.steady_time = steady ? account.steady_time + state.h_before : 0;
    const double s = std::clamp((steps_of_lasting - account.steady_time / h) / (steps_of_lasting - steps_of_passing), 0.0, 1.0);
    double lagged = std::max((lasting + s * (target - lasting) - kept_impulse) / contact_time, 0.0);
    if (std::abs(lagged - force) <= round_off * force) lagged = force;
    else factors[objects] = lagged / force;
    kept_impulses_[objects] = kept_impulse;
    account.applied = kept_impulse + contact_time * lagged;
    account.impulse_error = target - account.applied;
    account.normal = normal;
    account.sum_applied += account.applied;
    account.sum_normal += normal;
    account.largest = std::max(account.largest, normal);
  }
  if (!factors.empty()) friction_.scale_normal_forces(factors);
}

bool LaggedImpulses::update_start_up(const ContactPoints& now) {
  const FrictionTerm::PairForces forces = friction_.normal_forces(now);
  ++solves_;
  std::set<std::array<int, 2>> starting;
  bool again = false;
  for (auto& [objects, account] : accounts_) {
    if (!account.start_up) continue;
    const auto found = forces.find(objects);
    const double normal = contact_time_ * (found == forces.end() ? 0 : found->second), lagged = account.applied - kept_impulses_[objects];
    const double change = std::abs(lagged - normal);
    const bool small = change <= impulse_tolerance(objects);
    if (solves_ == 1 && (small || lagged <= (1 + excess_max) * normal)) {
      account.start_up = false;
      continue;
    }
    starting.insert(objects);
    again = again || (!small && change > change_max * std::max(lagged, normal));
  }
  if (!again || solves_ == max_solves) {
    compare(forces);
    return false;
  }
  friction_.replace_points(now, starting);
  for (const auto& objects : starting) {
    const auto found = forces.find(objects);
    FrictionAccount& account = accounts_[objects];
    account.sum_applied -= account.applied;
    account.applied = kept_impulses_[objects] + contact_time_ * (found == forces.end() ? 0 : found->second);
    account.sum_applied += account.applied;
    account.impulse_error = 0;
  }
  return true;
}

void LaggedImpulses::compare(const FrictionTerm::PairForces& forces) {
  for (auto& [objects, account] : accounts_) {
    const auto found = forces.find(objects);
    const double last = kept_fraction_ * account.normal + contact_time_ * (found == forces.end() ? 0 : found->second);
    const double all = account.sum_normal + last;
    const double tolerance = excess_max * all + std::max(account.largest, last) + impulse_tolerance(objects);
    const bool differs = account.sum_applied > all + tolerance || account.sum_applied < account.sum_normal - tolerance;
    if (!differs || account.warned) continue;
    account.warned = true;
    const int others = difference_ ? difference_->others + 1 : 0;
    const bool most = !difference_ || std::abs(account.sum_applied - all) > std::abs(difference_->applied - difference_->normal);
    if (most) difference_ = {objects, account.sum_applied, all, 0};
    difference_->others = others;
  }
}

}  // namespace tack
