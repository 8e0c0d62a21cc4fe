#include "framework/scene/friction_config.hpp"

#include <algorithm>
#include <cmath>

namespace tack {

void FrictionConfig::fields(Fields& f) {
  f.number("mu", mu, units::none, "coefficient of friction; 0 for none").required().nonnegative();
  f.choice("model", model,
           {{"smoothed", Model::smoothed, "friction of the sliding speed: contacts at rest creep below eps_v"},
            {"stick", Model::stick, "friction of the slip from an anchor (elastic spring, Coulomb's limit, return mapping): contacts at rest stay where they are"}},
           "how contacts at rest are held");
  f.optional_number("eps_v", eps_v, units::velocity,
                    "smoothed friction: sliding speed above which friction is fully developed; sticking contacts creep below it. The solver's "
                    "tolerance should be well below; 1 mm/s unless given").positive();
  f.optional_number("elastic_slip", elastic_slip, units::length,
                    "friction that sticks: elastic slip from the anchor at which friction is whole; a hundredth of contact.distance unless given").positive();
  f.optional_number("mu_static", mu_static, units::none,
                    "coefficient of static friction, at least mu, which is then that of kinetic friction; mu unless given").nonnegative();
  f.optional_number("stribeck_speed", stribeck_speed, units::velocity,
                    "sliding speed, above eps_v, up to which friction falls from static to kinetic; ten times eps_v unless given").positive();
  f.optional_number("mu_across", mu_across, units::none,
                    "coefficient of friction across the grain of one of the surfaces (objects[].grain), where mu is that along it; mu unless given").positive();
  f.check("mu_across", [this]() -> std::string { return mu_across && mu == 0 ? "needs a mu above 0" : ""; });
  f.check("eps_v", [this]() -> std::string { return eps_v && sticks() ? "is of smoothed friction; drop it, or give elastic_slip" : ""; });
  f.check("elastic_slip", [this]() -> std::string { return elastic_slip && !sticks() ? "is of friction that sticks; drop it, or give model: stick" : ""; });
  f.check("mu_static", [this]() -> std::string { return mu_static && *mu_static < mu ? "must be at least mu" : ""; });
  f.check("stribeck_speed", [this]() -> std::string {
    if (!stribeck_speed) return "";
    return !mu_static ? "needs mu_static" : sticks() || *stribeck_speed > full_speed() ? "" : "must be above eps_v";
  });
}

double blended(FrictionBlend blend, double first, double second) {
  switch (blend) {
    case FrictionBlend::geometric: return std::sqrt(first * second);
    case FrictionBlend::arithmetic: return (first + second) / 2;
    case FrictionBlend::harmonic: return first + second > 0 ? 2 * first * second / (first + second) : 0;
    case FrictionBlend::minimum: return std::min(first, second);
    case FrictionBlend::maximum: return std::max(first, second);
    default: return first * second;
  }
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
