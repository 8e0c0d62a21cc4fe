// Numerical energy gains and losses of a run: cause, amount and time. Reported at the end of the
// run, if they are noticeable against its reference energy; early in a run that is nearly zero.
// Groups of bodies that do not interact (stepping/group_balance.hpp) are judged by their own
// reference energies.
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
  // Damping integrators bring slow prescribed motion and loading to rest, jumps included, as
  // intended. Their losses are reported if at least this fraction of the reference energy is
  // motion.
  static constexpr double motion = 0.25;

  // Sums of dissipated_numerics or dissipated_areas of one cause.
  struct Cause {
    double lost = 0, made = 0;      // the most that was in any stretch of steps [J]
    double losing = 0, making = 0;  // in the stretch up to now [J]
    double sum = 0, in_contact = 0;  // lost less made [J]: in all steps, and in those with contact
    TimeHistogram when;             // the same over time

    void add(const StepReport& report, double dissipated, double jerk, bool contact);
  };
  // Losses of a group of bodies.
  struct Group {
    Cause integrator, repeated;         // areas of contact count with them
    double reference_energy = 0, moving = 0, noise = 0;
    bool met_another = false;  // the group has met another one, and its own energy is not known

    void add(const StepReport& report, const GroupFlow& flow);
  };
  Cause areas;       // contact's areas, taken anew
  Cause integrator;  // the rule of time integration
  Cause repeated;    // implicit Euler, in steps that were done again with it

  double reference_energy = 0, moving = 0;  // J (core/reference_energy.hpp); its kinetic part
  double noise = 0;    // changes by solver tolerance, squared and summed [J^2]
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
