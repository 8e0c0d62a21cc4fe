// Points at which forces between surfaces act, as a structured array.
#pragma once

#include "framework/world/world.hpp"
#include "python/bindings/arrays.hpp"

namespace tack::python {

// Returns the points of the terms with this name (ForcePoints, framework/core/force_point.hpp) at
// x, which is the configuration of the contact system: a row per point. summand: "" for the whole
// force. Throws py::value_error for a name without points and an unknown summand.
py::array force_points(const World& world, const VecX& x, const std::string& name,
                       const std::string& summand);

}  // namespace tack::python
