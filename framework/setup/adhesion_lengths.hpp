// Lengths over which an adhesive interface fails. Elements have to be smaller.
#pragma once

#include <array>

#include "framework/scene/scene_config.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Mesh sizes over these lengths: the recommended one, and the largest that resolves bending.
inline constexpr double mesh_size_per_process_zone = 1.0 / 3,
                        mesh_size_max_per_bending_length = 0.5;
// Largest change of the gap across an element, over the range of adhesion.
inline constexpr double gap_change_per_range = 0.25;

// Returns the process zone E W / sigma^2 [m] of a solid (Hillerborg et al. 1976). young: E of the
// softer side [Pa]; work: W [J/m^2]; peak: the largest traction sigma [Pa].
double process_zone(double young, double work, double peak);
// Returns the length over which a sheet or a rod bends where it lets go, (2 B W / sigma^2)^(1/4)
// [m]. stiffness: B per width [N m].
double bending_length(double stiffness, double work, double peak);
// Returns the bending stiffness of a sheet or a rod in its softest direction, per width [N m]; 0
// for objects that do not resist bending.
double bending_stiffness(const ObjectConfig& object, const Body& body);

// Stiffness of the softer sides of a pair. Sheets and rods bend where they let go, solids stretch.
struct PairStiffness {
  double young = 0;    // of the softer side that does not resist bending [Pa]; 0: there is none
  double bending = 0;  // of the softer side that does, per width [N m]; 0: there is none
};
PairStiffness pair_stiffness(const SceneConfig& scene, const World& world,
                             const std::array<int, 2>& pair);

}  // namespace tack
