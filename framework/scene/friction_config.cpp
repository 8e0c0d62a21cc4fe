#include "framework/scene/friction_config.hpp"

namespace tack {

void FrictionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "coefficient of friction; 0 for none").required().nonnegative();
  f.number("eps_v", eps_v, units::velocity,
           "sliding speed above which friction is fully developed; sticking contacts creep below it. The solver's "
           "tolerance should be well below").positive();
}

void TangentialAdhesionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "mu_a: largest tangential over largest normal adhesion").nonnegative();
  f.optional_number("eps_a", eps_a, units::velocity,
                    "sliding speed of the largest tangential adhesion, which vanishes at twice that speed; the eps_v "
                    "of the pair's friction unless given, or 1 mm/s without friction").positive();
}

void LaggingConfig::fields(Fields& f) {
  f.integer("iterations", iterations,
            "solves per step, each with the normal forces and tangents of the previous solution; 1: those of the "
            "start of the step, except in the first steps of objects that begin in contact").at_least(1);
  f.optional_number("until", until, units::none,
                    "change of tangential forces, relative to the largest, below which these iterations end; a "
                    "warning is printed if it is not reached").positive();
}

}  // namespace tack
