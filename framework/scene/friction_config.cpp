#include "framework/scene/friction_config.hpp"

namespace tack {

void FrictionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "coefficient of friction; 0 for none").required().nonnegative();
  f.number("eps_v", eps_v, units::velocity,
           "sliding speed above which friction is fully developed; sticking contacts creep below it. The solver's "
           "tolerance should be well below").positive();
  f.optional_number("mu_static", mu_static, units::none,
                    "coefficient of static friction, at least mu, which is then that of kinetic friction; mu unless given").nonnegative();
  f.optional_number("stribeck_speed", stribeck_speed, units::velocity,
                    "sliding speed, above eps_v, up to which friction falls from static to kinetic; ten times eps_v unless given").positive();
  f.check("mu_static", [this]() -> std::string { return mu_static && *mu_static < mu ? "must be at least mu" : ""; });
  f.check("stribeck_speed", [this]() -> std::string {
    if (!stribeck_speed) return "";
    return !mu_static ? "needs mu_static" : *stribeck_speed > eps_v ? "" : "must be above eps_v";
  });
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
