#include "energies/plasticity/flow_parameters.hpp"

#include <fmt/format.h>

#include "framework/config/field.hpp"

namespace tack {

void FlowParameters::fields(Fields& f, const char* drawn) {
  f.number("yield_stress", yield_stress, units::pressure, fmt::format("stress at which a {} in tension begins to flow", drawn)).required().positive();
  f.number("hardening", hardening, units::pressure,
           fmt::format("H: what the yield stress grows by per accumulated plastic strain (equivalent, that of a {0}); a {0} in tension then "
                       "has the tangent modulus E H / (E + H). 0: perfect plasticity", drawn)).nonnegative();
  f.number("viscosity", viscosity, units::viscosity,
           fmt::format("eta: by what the stress exceeds the yield stress per rate of plastic strain (equivalent, that of a {}): sigma = yield_stress + "
                       "hardening a + viscosity da/dt, of Perzyna. 0: flow as fast as it is led", drawn)).nonnegative();
}

}  // namespace tack
