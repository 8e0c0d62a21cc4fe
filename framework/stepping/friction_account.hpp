// Account of friction that lags by a step, for two objects: the normal impulses that friction was
// applied with, and those it still owes (lagged_impulses.hpp).
#pragma once

#include <array>
#include <map>

#include "framework/core/history.hpp"

namespace tack {

struct FrictionAccount {
  double owed = 0;    // before the impulse of the last step counts [N s]
  double normal = 0;  // impulse of the step before that [N s]
  double given = 0;   // to friction in the last step, over mu [N s]
  double calm_force = 0, calm_time = 0;  // steady normal force [N] and its duration [s]
  bool settling = false;  // start-up: friction by normal forces that no step has found
  // Since the contact was made [N s]: sum of impulses applied to friction, sum of normal impulses
  // without that of the last step, and the largest of these. told: their difference was warned of.
  double all_given = 0, all_normal = 0, largest = 0;
  bool told = false;
};

using FrictionAccounts = std::map<std::array<int, 2>, FrictionAccount>;  // by object pair

// Name in histories. It contains no object: a scene that starts from the state of another owes
// nothing.
inline constexpr const char* owed_friction_name = "owed friction";

FrictionAccounts accounts_of(const History& history);
HistoryArray array_of(const FrictionAccounts& accounts);

}  // namespace tack
