// Properties of a scene that pictures and exported files need besides the frames of its run.
#pragma once

#include <optional>

#include "framework/experiment/experiment.hpp"

namespace tack {

// Returns the radius of the rods or particles of an object [m]; nullopt: its elements have none.
std::optional<double> drawn_radius(const ObjectConfig& object);

// Returns the unit vector against gravity; without gravity, y.
Vec3 up_direction(const Experiment& experiment);

}  // namespace tack
