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
  static constexpr double tolerated_fraction = 0.03;  // of the reference energy
  // Damping integrators bring slow prescribed motion and loading to rest, jumps included, as
  // intended. Their losses are reported if at least this fraction of the reference energy is
  // motion.
  static constexpr double moving_fraction_min = 0.25;

  // Sums of dissipated_numerics or dissipated_areas of one cause.
  struct Cause {
    double lost = 0, gained = 0;     // largest loss and gain in successive steps [J]
    double losing = 0, gaining = 0;  // loss and gain in the present run of steps [J]
    double sum = 0, in_contact = 0;  // net loss [J]: of all steps, and of those with contact
    TimeHistogram over_time;         // net loss over time

    void add(const StepReport& report, double dissipated, double jerk, bool contact);
  };
  // Losses of a group of bodies.
  struct Group {
    Cause integrator, repeated;  // include areas of contact
    double reference_energy = 0, moving = 0, noise = 0;
    bool met_another = false;  // the group has met another one, so that its energy is unknown

    void add(const StepReport& report, const GroupFlow& flow);
  };
  Cause areas;       // re-evaluated areas of contact
  Cause integrator;  // time integration
  Cause repeated;    // implicit Euler, in steps that were repeated with it

  double reference_energy = 0, moving = 0;  // J (core/reference_energy.hpp); its kinetic part
  double noise = 0;                         // changes by solver tolerance, squared and summed [J^2]
  std::vector<Group> groups;                // empty: all bodies are one group

  void add(const StepReport& report);
  // Returns a warning for each cause that gained or lost more than is tolerated, the largest first.
  // They are by group if there are several groups with these names and none has met another.
  std::vector<Warning> warnings(const TimeIntegrator& rule,
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
