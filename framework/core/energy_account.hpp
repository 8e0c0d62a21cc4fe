// State of the energy balance between steps (energy_balance.hpp).
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "framework/core/reference_energy.hpp"
#include "geometry/types.hpp"

namespace tack {

/// Energy balance of a group of bodies (stepping/group_balance.hpp).
struct GroupAccount {
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;  // J
  double dissipated = 0;                                      // so far [J]
  ReferenceEnergy reference_energy;                           // so far
  bool met_another = false;  // a contact stencil joined another group: the energy is unknown
};

/// Energy balance of all bodies.
struct EnergyAccount {
  bool open = false;  // false: the energies of the state are not known yet
  // Energies of the state, for the vertices that were free in the last step [J].
  double kinetic = 0, gravity = 0, elastic = 0, contact = 0;
  // Dissipated so far, by name (EnergyFlows::Published::account) [J].
  std::vector<std::pair<std::string, double>> dissipated;
  double loads = 0;  // work of the loads so far [J]
  VecX gradient;     // 3n: of elastic and contact energy [N]; empty without prescribed motion

  double numerical_gain = 0;         // numerical energy gain since the first step [J]
  double numerical_gain_low = 0;     // its smallest value since the last reported gain [J]
  ReferenceEnergy reference_energy;  // so far
  double numerical_gain_min = 0;     // its smallest value in the run [J]
  int growing_steps = 0;             // consecutive steps with a gain far above its smallest value
  bool growth_warned = false;        // the warning about lasting growth was given
  std::vector<GroupAccount> groups;  // empty: all bodies are one group

  /// Returns the energy dissipated under a name [J]; 0 for an unknown name.
  double dissipated_as(const std::string& name) const {
    for (const auto& [other, amount] : dissipated)
      if (other == name) return amount;
    return 0;
  }
  double all_dissipated() const {
    double sum = 0;
    for (const auto& [name, amount] : dissipated) sum += amount;
    return sum;
  }
  // Returns the account of a name; a new account starts at its amount in `before`.
  double& account(const std::string& name, const EnergyAccount& before) {
    for (auto& [other, amount] : dissipated)
      if (other == name) return amount;
    return dissipated.emplace_back(name, before.dissipated_as(name)).second;
  }
};

}  // namespace tack
