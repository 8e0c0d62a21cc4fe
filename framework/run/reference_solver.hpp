// Settings of the solver that finds reference minima of steps.
#pragma once

#include <string>

#include "framework/config/value.hpp"

namespace tack {

/// Smallest and largest tolerance of a reference minimum [m/s]: where round-off prevents the
/// first, ten times more is tried, up to the second.
inline constexpr double reference_tolerance_min = 1e-10, reference_tolerance_max = 1e-6;

/// Returns the keys of projected Newton, to be laid over the solver of a scene. tolerance: of the
/// velocity [m/s], and of the residual force in quasi-static steps (relative).
Value reference_solver(const std::string& projection, const std::string& linear, double tolerance);

}  // namespace tack
