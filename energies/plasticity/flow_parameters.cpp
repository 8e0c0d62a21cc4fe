#include "energies/plasticity/flow_parameters.hpp"

#include <fmt/format.h>

#include "framework/config/field.hpp"

namespace tack {

void FlowParameters::fields(Fields& f, const char* drawn) {
  f.number("yield_stress", yield_stress, units::pressure, fmt::format("stress at which a {} in tension begins to flow", drawn)).required().positive();
  f.number("hardening", hardening, units::pressure,
           fmt::format("H: growth of the yield stress per accumulated equivalent plastic strain; the tangent modulus "
                       "of a {0} in tension is then E H / (E + H). 0: perfect plasticity", drawn)).nonnegative();
  f.number("viscosity", viscosity, units::viscosity,
           fmt::format("eta: overstress per rate of equivalent plastic strain (Perzyna); for a {} in tension sigma = "
                       "yield_stress + hardening a + viscosity da/dt. 0: rate-independent", drawn)).nonnegative();
}

}  // namespace tack
