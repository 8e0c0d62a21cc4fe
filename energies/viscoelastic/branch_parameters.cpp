#include "energies/viscoelastic/branch_parameters.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {

void BranchParameters::stiffness_fields(Fields& f) {
  f.optional_number("modulus", modulus, units::pressure, "shear modulus of the spring").positive();
  f.optional_number("fraction", fraction, units::none, "shear modulus of the spring over that of the energy beside it, at small strains, instead of modulus").positive();
  f.check("modulus", [this]() -> std::string { return modulus.has_value() != fraction.has_value() ? "" : "and fraction: give one of the two"; });
}

void BranchParameters::time_fields(Fields& f) {
  f.number("time", time, units::time, "relaxation time: the stress at constant strain falls by 1/e").required().positive();
  shift.fields(f, "time");
}

double BranchParameters::shear(const Body& body, std::string_view type) const {
  return modulus ? *modulus : *fraction * *base_of(body, type, "`modulus`").shear();
}

const Energy& base_of(const Body& body, std::string_view type, std::string_view instead) {
  const Energy* base = nullptr;
  int count = 0;
  for (const auto& energy : body.energies)
    if (energy->shear()) base = energy.get(), ++count;
  if (count != 1)
    throw InputError(fmt::format("object '{}': {} takes a fraction of the shear modulus of the energy beside it, and {} of its energies have one; give {}", body.name, type,
                                 count == 0 ? std::string("none") : std::to_string(count), instead));
  return *base;
}

}  // namespace tack
