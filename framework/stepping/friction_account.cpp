#include "framework/stepping/friction_account.hpp"

#include <stdexcept>

namespace tack {
namespace {

constexpr int width = 12;

}  // namespace

FrictionAccounts accounts_of(const History& history) {
  FrictionAccounts accounts;
  const auto found = history.find(friction_account_name);
  if (found == history.end()) return accounts;
  if (found->second.width != width) throw std::logic_error("the friction account has another width");
  for (int i = 0; i < found->second.entries(); ++i) {
    const double* v = found->second.values.data() + width * i;
    accounts[{static_cast<int>(v[0]), static_cast<int>(v[1])}] = {v[2], v[3], v[4], v[5], v[6], v[7] != 0, v[8], v[9], v[10], v[11] != 0};
  }
  return accounts;
}

HistoryArray array_of(const FrictionAccounts& accounts) {
  HistoryArray array{width, {}, {}};
  for (const auto& [objects, a] : accounts)
    array.values.insert(array.values.end(), {double(objects[0]), double(objects[1]), a.impulse_error, a.normal, a.applied, a.steady_force, a.steady_time,
                                             double(a.start_up), a.sum_applied, a.sum_normal, a.largest, double(a.warned)});
  return array;
}

}  // namespace tack
