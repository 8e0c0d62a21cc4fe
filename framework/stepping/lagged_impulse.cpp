#include "framework/stepping/lagged_impulse.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "framework/contact/friction_term.hpp"

namespace tack {
namespace {

constexpr double calm_change = 0.25;  // by less than that part of the larger one, forces change where a contact lasts
constexpr double short_while = 2, long_while = 4;  // of the next step: for how long it has lasted where s is 1, and 0
constexpr double for_ever = 1e30;     // s
constexpr double alike = 1e-9;        // the part by which forces of steps that are alike may differ

// Of two objects.
struct Account {
  double owed = 0;    // before the impulse of the last step counts [N s]
  double normal = 0;  // impulse of the step before that [N s]
  double given = 0;   // to friction in the last step, over mu [N s]
  double calm_force = 0, calm_time = 0;  // the normal force within a quarter of which it has stayed [N], and for how long [s]
};
constexpr int width = 7;  // and the two objects

std::map<std::array<int, 2>, Account> accounts_of(const History& history) {
  std::map<std::array<int, 2>, Account> accounts;
  const auto found = history.find(owed_friction_name);
  if (found == history.end()) return accounts;
  if (found->second.width != width) throw std::logic_error("what friction owes has another width");
  for (int i = 0; i < found->second.entries(); ++i) {
    const double* v = found->second.values.data() + width * i;
    accounts[{static_cast<int>(v[0]), static_cast<int>(v[1])}] = {v[2], v[3], v[4], v[5], v[6]};
  }
  return accounts;
}

}  // namespace

HistoryArray carry_friction(FrictionTerm& friction, const State& state, double h, double acting) {
  const auto accounts = accounts_of(state.history);
  const bool first = state.h_before == 0 || state.acted_before == 0;
  const double kept = 1 - acting / h;  // a
  HistoryArray next{width, {}, {}};
  FrictionTerm::PairForces factors;
  for (const auto& [objects, force] : friction.normal_forces()) {
    if (force == 0) continue;
    Account account;
    if (first) {
      account = {0, h * force, h * force, force, for_ever};
    } else {
      if (const auto found = accounts.find(objects); found != accounts.end()) account = found->second;
      const double normal = (1 - state.acted_before / state.h_before) * account.normal + state.acted_before * force;
      const double due = account.owed + normal, lasting = normal * h / state.h_before;
      const bool calm = std::abs(force - account.calm_force) < calm_change * std::max(force, account.calm_force);
      if (!calm) account.calm_force = force;
      account.calm_time = calm ? account.calm_time + state.h_before : 0;
      const double s = std::clamp((long_while - account.calm_time / h) / (long_while - short_while), 0.0, 1.0);
      double held = std::max((lasting + s * (due - lasting) - kept * account.given) / acting, 0.0);
      if (std::abs(held - force) <= alike * force) held = force;
      else factors[objects] = held / force;
      account.given = kept * account.given + acting * held;
      account.owed = due - account.given;
      account.normal = normal;
    }
    next.values.insert(next.values.end(), {double(objects[0]), double(objects[1]), account.owed, account.normal,
                                           account.given, account.calm_force, account.calm_time});
  }
  if (!factors.empty()) friction.scale_normal_forces(factors);
  return next;
}

}  // namespace tack
