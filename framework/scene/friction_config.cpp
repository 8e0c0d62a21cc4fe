#include "framework/scene/friction_config.hpp"

namespace tack {

void FrictionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "coefficient of friction; 0 for none").required().nonnegative();
  f.number("eps_v", eps_v, units::velocity,
           "sliding speed from which friction is whole; what sticks creeps more slowly. The solver's "
           "tolerance should be well below").positive();
}

void TangentialAdhesionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "mu_a: largest tangential over largest normal adhesion").nonnegative();
  f.optional_number("eps_a", eps_a, units::velocity,
                    "sliding speed of the largest tangential adhesion, which is gone at twice that speed; "
                    "the eps_v of the pair's friction unless given, or 1 mm/s without friction").positive();
}

void LaggingConfig::fields(Fields& f) {
  f.integer("iterations", iterations,
            "how often a step is solved, each time with the normal forces and tangents of the solution "
            "before; 1: those of the start of the step, except in the first steps of objects that begin in contact").at_least(1);
  f.optional_number("until", until, units::none,
                    "ends these iterations once tangential forces change by less, relative to the largest of "
                    "them; not reaching it is a warning").positive();
}

}  // namespace tack
