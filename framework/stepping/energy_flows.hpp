// Energy flows of one step [J] (energy_balance.hpp).
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "framework/core/records.hpp"

namespace tack {

// Energy flows of a group of bodies in one step [J] (group_balance.hpp), as far as they are known
// for a group; members as in EnergyFlows.
struct GroupFlow {
  double numerics = 0;  // lost by contact areas and integrator; below zero: gained
  double jerk = 0, noise = 0, reference_energy = 0, moving = 0;
  bool in_contact = false;
  bool met_another = false;  // in contact with another group, now or earlier
};

struct EnergyFlows {
  // A flow that is a column of files: flows that every scene has, then others that terms publish.
  // Flows fed in and flows within the energy come before dissipated ones.
  struct Published {
    std::string column;
    FlowKind kind;
    std::string account;  // of a dissipated flow: name of the running total that it counts in
    double amount = 0;
  };

  EnergyFlows();  // the flows that every scene has
  explicit EnergyFlows(const Records& records);

  double loads = 0, prescribed_motion = 0;  // external work
  std::vector<Published> published;
  double areas = 0, numerics = 0;  // dissipated
  // Work of the prescribed motion by the forces at the end of the step, less `prescribed_motion`.
  double jerk = 0;
  double noise = 0;  // possible change by the tolerance of the solver
  // Reference energy: the largest moved energy of the run so far (core/reference_energy.hpp), with
  // the kinetic energy of this step, less that of bodies in free flight.
  double reference_energy = 0;
  double moving = 0;  // kinetic part of the reference energy
  // True with contact at the start or end of the step, or energy between objects at its end.
  bool in_contact = false;
  bool damped = false;            // repeated with the fallback integrator to avoid a gain
  bool refined = false;           // shorter than the scene's step, to conserve energy
  std::vector<GroupFlow> groups;  // of the step alone; empty: all bodies are one group
  bool gained = false;            // noticeable numerical gain
  bool lost = false;              // noticeable numerical loss, beyond earlier gains

  // Returns whether the numerical gain by re-evaluated contact areas exceeds that by time
  // integration.
  bool gained_by_areas() const { return areas < numerics; }

  // Returns the amount of a published flow; 0 if there is none.
  double of(std::string_view column) const;
  // Returns a reference to a published flow, and adds one of that kind if there is none.
  double& amount(const std::string& column, FlowKind kind = FlowKind::dissipated);
  // Returns the sum of the published flows of a kind.
  double sum(FlowKind kind) const;

  // Adds all flows of a file; other members stay.
  EnergyFlows& operator+=(const EnergyFlows& o);
  // Calls act(column, amount) for each flow, in the order of the files.
  template <class Flows, class Act>
  static void for_each(Flows&& flows, const Act& act) {
    act("work_loads", flows.loads);
    act("work_script", flows.prescribed_motion);
    for (auto& f : flows.published) act(f.column, f.amount);
    act("dissipated_areas", flows.areas);
    act("dissipated_numerics", flows.numerics);
  }
};

}  // namespace tack
