// Lengths over which an adhesive interface fails. Elements have to be smaller.
#pragma once

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Elements of a mesh that resolves them, over these lengths: recommended, and at most.
inline constexpr double mesh_size_per_zone = 1.0 / 3, largest_per_bending_length = 0.5;

// Returns the process zone E W / sigma^2 [m] of a solid (Hillerborg et al. 1976). young: E of the
// softer side [Pa]; work: W [J/m^2]; peak: the largest traction sigma [Pa].
double process_zone(double young, double work, double peak);
// Returns the length over which a sheet or a rod bends where it lets go, (2 B W / sigma^2)^(1/4)
// [m]. stiffness: B per width [N m].
double bending_length(double stiffness, double work, double peak);
// Returns the bending stiffness of a sheet or a rod in its softest direction, per width [N m]; 0
// for objects that do not resist bending.
double bending_stiffness(const ObjectConfig& object, const Body& body);

}  // namespace tack
