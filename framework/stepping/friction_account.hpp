// Account of friction that lags by a step, for a pair of objects: normal impulses that friction was
// applied with, and the accumulated impulse error (lagged_impulses.hpp).
#pragma once

#include <array>
#include <map>

#include "framework/core/history.hpp"

namespace tack {

struct FrictionAccount {
  double impulse_error = 0;  // accumulated, without the impulse of the last step [N s]
  double normal = 0;         // normal impulse of the step before the last [N s]
  double applied = 0;        // impulse of friction in the last step, over mu [N s]
  double steady_force = 0, steady_time = 0;  // steady normal force [N] and its duration [s]
  bool start_up = false;  // friction acts by normal forces that no step has computed
  // Sums since the contact was made [N s]: impulses applied to friction; normal impulses without
  // that of the last step, and the largest of them.
  double sum_applied = 0, sum_normal = 0, largest = 0;
  bool warned = false;  // a warning of the difference of both sums was given
};

using FrictionAccounts = std::map<std::array<int, 2>, FrictionAccount>;  // by object pair

// Name in histories. It contains no object, so that a scene with an initial state from a run starts
// without accounts.
inline constexpr const char* friction_account_name = "owed friction";

// Returns the accounts in a history.
FrictionAccounts accounts_of(const History& history);
// Returns the accounts as an array of a history.
HistoryArray array_of(const FrictionAccounts& accounts);

}  // namespace tack
