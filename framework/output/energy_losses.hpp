// The energy that a run made or lost and that no physics accounts for: why, how much, and when. Told at its end, if it is
// noticeable against the most that was at play in the run: early on, next to nothing is.
// Where bodies are in groups that have nothing to do with each other (stepping/group_balance.hpp),
// each group is judged by what was at play in it.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "framework/core/warning.hpp"
#include "framework/output/time_histogram.hpp"
#include "framework/stepping/step_report.hpp"
#include "framework/stepping/time_integrator.hpp"

namespace tack {

struct EnergyLosses {
  static constexpr double tolerated = 0.03;  // of what is at play
  // Integrators that damp bring to rest what a script or load moves slowly, jumps included, as it is meant to be. What they lose
  // is told where this part or more of what is at play is motion.
  static constexpr double motion = 0.25;

  // Of dissipated_numerics and dissipated_areas.
  struct Cause {
    double lost = 0, made = 0;      // the most that was in any stretch of steps [J]
    double losing = 0, making = 0;  // in the stretch up to now [J]
    double sum = 0, in_contact = 0;  // of what was lost less what was made, in all steps and those with contact [J]
    TimeHistogram when;             // the same over time

    void add(const StepReport& report, double dissipated, double jerk, bool contact);
  };
  // Of a group of bodies.
  struct Group {
    Cause integrator, repeated;         // areas of contact count with them
    double at_play = 0, moving = 0, noise = 0;
    bool met_another = false;  // the group has met another one, and its own energy is not known

    void add(const StepReport& report, const GroupFlow& flow);
  };
  Cause areas;       // contact's areas, taken anew
  Cause integrator;  // the rule of time integration
  Cause repeated;    // implicit Euler, in steps that were done again with it

  double at_play = 0, moving = 0;  // J (core/energy_at_play.hpp); its kinetic part
  double noise = 0;    // what the solver's tolerance may have changed it by, squared and summed up [J^2]
  std::vector<Group> groups;  // empty: all bodies are one group

  void add(const StepReport& report);
  // A line for each cause that made or lost more than is tolerated, the largest first; of groups
  // with these names where there are several and none has met another.
  std::vector<Warning> told(const TimeIntegrator& rule,
                            const std::vector<std::string>& group_names = {}) const;

  // Calls act(name, cause) for each.
  template <class Losses, class Act>
  static void for_each(Losses&& losses, const Act& act) {
    act("areas", losses.areas);
    act("integrator", losses.integrator);
    act("repeated", losses.repeated);
  }
};

}  // namespace tack
