#include "framework/stepping/time_config.hpp"

namespace tack {

void TimeConfig::fields(Fields& f) {
  f.number("step", step, units::time, "time step h").positive();
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
}

}  // namespace tack
