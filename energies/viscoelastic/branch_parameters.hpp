// Parameters of all Maxwell branches in a scene: the stiffness of the spring, of its own or as a
// fraction of the energy beside which it acts, and the relaxation time with its temperature shift.
#pragma once

#include <optional>
#include <string_view>

#include "framework/body/body.hpp"
#include "framework/bond/temperature_shift.hpp"
#include "framework/config/field.hpp"
#include "framework/scene/energy.hpp"

namespace tack {

struct BranchParameters {
  std::optional<double> modulus;   // shear modulus of the spring [Pa]
  std::optional<double> fraction;  // of the shear modulus of the base [1]
  double time = 1;                 // relaxation time at constant strain [s]
  TemperatureShift shift;          // of the time

  /// Appends the fields of the stiffness, of which a scene gives one.
  void stiffness_fields(Fields& f);
  void time_fields(Fields& f);
  /// Returns the shear modulus of the spring [Pa]. Throws InputError for a fraction without a base.
  double shear(const Body& body, std::string_view type) const;
};

/// Returns the base of the branches of a body: the one energy of its object with a shear modulus.
/// Throws InputError that names the object, the branch and `instead` unless there is one.
const Energy& base_of(const Body& body, std::string_view type, std::string_view instead);

}  // namespace tack
