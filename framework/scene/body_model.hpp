// Motion of an object as a whole: `body: affine` gives it twelve unknowns, whatever its mesh.
// Without a body model its vertices are free.
#pragma once

#include <optional>

#include "framework/config/field.hpp"
#include "framework/config/registry.hpp"

namespace tack {

class BodyModel : public Component {
 public:
  static constexpr const char* kind_name = "body";
  static constexpr const char* kind_doc = "Kinematics of an object as a whole.";

  virtual double density() const = 0;                   // kg/m^3
  virtual std::optional<double> stiffness() const = 0;  // Pa
};

}  // namespace tack
