#include "framework/stepping/time_config.hpp"

#include <fmt/format.h>

namespace tack {

void AdaptiveConfig::fields(Fields& f) {
  f.number("error", error, units::length,
           "by how far the end of a step may be off, estimated by a formula of another order: the root of the mean square over the mass of "
           "a body, of the body for which that is largest. A step that is off by more is repeated with a smaller one")
      .required().positive();
  f.optional_number("smallest", smallest, units::time, "the smallest step, kept whatever its error; a thousandth of time.step unless given").positive();
  f.optional_number("largest", largest, units::time, "the largest step; ten times time.step unless given").positive();
}

double TimeConfig::smallest_step() const { return adaptive->smallest.value_or(step / 1000); }
double TimeConfig::largest_step() const { return adaptive ? adaptive->largest.value_or(10 * step) : step; }

void TimeConfig::fields(Fields& f) {
  f.number("step", step, units::time, "time step h; of steps that adapt, the first").positive();
  f.optional_object("adaptive", adaptive, "steps whose sizes follow an error; all are of one size unless given");
  f.number("duration", duration, units::time, "simulated time").positive();
  f.component("integrator", integrator, "time integration");
  f.component("stepper", stepper, "how a step is solved");
  f.optional_number("wall_limit", wall_limit, units::time,
                    "wall time of the program, after which it ends with what it has and exit code 3; a run that is resumed has all of "
                    "it again; none unless given")
      .positive();
  f.integer("max_halvings", max_halvings,
            "how often a failed step may be halved before the run gives up; and one in which a body that goes further than its own size went "
            "around what is in its way, before that is kept and told")
      .range(0, 30);
  f.check("step", [this]() -> std::string {
    constexpr double least = 1e-100;  // s: incremental potentials are divided by its square
    return step >= least ? "" : fmt::format("{:g} s is too short to compute with, its square is no number; take {:g} s or more", step, least);
  });
  f.check("adaptive", [this]() -> std::string {
    constexpr double finest = 1e-6;  // of the first step: times are told apart down to a thousandth of that
    if (!adaptive || (step >= smallest_step() && step <= largest_step() && smallest_step() >= finest * step)) return "";
    return fmt::format("time.step, the first, is {0} s: smallest ({1} s) must be between {2} s and that, largest ({3} s) not below it", step,
                       smallest_step(), finest * step, largest_step());
  });
}

}  // namespace tack
