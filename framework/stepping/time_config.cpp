#include "framework/stepping/time_config.hpp"

#include <fmt/format.h>

namespace tack {

void AdaptiveConfig::fields(Fields& f) {
  f.number("error", error, units::length,
           "largest position error of a step, estimated by a formula of another order: mass-weighted RMS per body, "
           "the largest over bodies. A step with a larger error is repeated with a smaller size")
      .required().positive();
  f.optional_number("smallest", smallest, units::time, "the smallest step, kept whatever its error; a thousandth of time.step unless given").positive();
  f.optional_number("largest", largest, units::time, "the largest step; ten times time.step unless given").positive();
}

double TimeConfig::smallest_step() const { return adaptive->smallest.value_or(step / 1000); }
double TimeConfig::largest_step() const { return adaptive ? adaptive->largest.value_or(10 * step) : step; }

void TimeConfig::fields(Fields& f) {
  f.number("step", step, units::time, "time step h; with adaptive steps, the first one").positive();
  f.optional_object("adaptive", adaptive, "adaptive time steps by error control; constant steps unless given");
  f.number("duration", duration, units::time, "simulated time").positive();
  f.component("integrator", integrator, "time integration");
  f.component("stepper", stepper, "method that solves a step");
  f.optional_number("wall_limit", wall_limit, units::time,
                    "wall time after which the run ends with the results so far and exit code 3; a resumed run has "
                    "the whole limit again; none unless given")
      .positive();
  f.integer("max_cutbacks", max_cutbacks,
            "largest number of cutbacks (halvings into substeps) of a failed step before the run ends with an error; "
            "also of a step with tunnelling, after which the step is accepted with a warning")
      .range(0, 30);
  f.choice("energy_repeats", energy_repeats,
           {{"auto", EnergyRepeats::automatic, "if the integrator has a fallback: newmark, with implicit_euler"},
            {"always", EnergyRepeats::always, "with every integrator"},
            {"never", EnergyRepeats::never, "energy gain and loss are reported only"}},
           "whether steps with numerical energy gain or loss are repeated with smaller sizes, down to an eighth of `step`, or with the integrator's fallback");
  f.flag("resolve_debonding", resolve_debonding,
         "whether a step in which a body debonds at once (adhesion or bonds) is repeated in smaller ones, so that the adhesion takes its work of adhesion from the motion");
  f.check("resolve_debonding", [this]() -> std::string {
    if (!resolve_debonding) return "";
    if (!stepper->resolves_debonding()) return fmt::format("the stepper {} does not check it", stepper->type());
    return integrator->inertia() ? "" : fmt::format("{} has no inertia, and debonds at once whatever its steps; remove it", integrator->type());
  });
  f.check("step", [this]() -> std::string {
    constexpr double least = 1e-100;  // s: incremental potentials are divided by the square of the step
    return step >= least ? "" : fmt::format("{:g} s is too short to compute with, its square is no number; take {:g} s or more", step, least);
  });
  f.check("adaptive", [this]() -> std::string {
    constexpr double finest = 1e-6;  // of the first step; times are resolved to a thousandth of this
    if (!adaptive || (step >= smallest_step() && step <= largest_step() && smallest_step() >= finest * step)) return "";
    return fmt::format("time.step, the first, is {0} s: smallest ({1} s) must be between {2} s and that, largest ({3} s) not below it", step,
                       smallest_step(), finest * step, largest_step());
  });
}

}  // namespace tack
