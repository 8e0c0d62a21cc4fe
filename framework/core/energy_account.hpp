// What the balance of energy carries from step to step (energy_balance.hpp).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/core/energy_at_play.hpp"
#include "geometry/types.hpp"

namespace tack {

// The same for a group of bodies (stepping/group_balance.hpp).
struct GroupAccount {
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;  // J
  double dissipated = 0;  // so far [J]
  EnergyAtPlay at_play;   // so far
  bool met_another = false;  // a stencil of contact has ended in another group: its own energy is not known
};

struct EnergyAccount {
  bool open = false;  // false: nothing is known of the state's energies yet
  // Of the state, of all that was free in the step before [J].
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;
  // Dissipated so far, by name (EnergyFlows::Published::account) [J].
  std::vector<std::pair<std::string, double>> dissipated;
  double loads = 0;  // what loads have done so far [J]
  VecX gradient;  // 3n: of elastic and contact energy [N]; empty if no script moves anything

  double unexplained = 0;  // energy that nothing put in, from the first step on [J]
  double lowest = 0;       // its smallest value since the last gain that was told of [J]
  EnergyAtPlay at_play;    // so far
  double bottom = 0;       // the smallest value of all of `unexplained` [J]
  int grown_steps = 0;     // steps behind us in all of which it was far above that
  bool told = false;       // that it was for long
  std::vector<GroupAccount> groups;  // empty: all bodies are one group

  double dissipated_as(const std::string& name) const {  // 0 of what was not
    for (const auto& [other, amount] : dissipated)
      if (other == name) return amount;
    return 0;
  }
  double all_dissipated() const {
    double sum = 0;
    for (const auto& [name, amount] : dissipated) sum += amount;
    return sum;
  }
  // To count on what it was before.
  double& account(const std::string& name, const EnergyAccount& before) {
    for (auto& [other, amount] : dissipated)
      if (other == name) return amount;
    return dissipated.emplace_back(name, before.dissipated_as(name)).second;
  }
};

}  // namespace tack
