// State of a bond site: what a bond law may depend on beside opening, slip, history variables and
// step size. It is constant within a step.
#pragma once

#include <array>
#include <string_view>

#include "geometry/types.hpp"

namespace tack {

inline constexpr double room_temperature = 293.15;  // K

/// State of the site of one bond. The stored energy of a law may depend on time, temperature,
/// rest position and objects: its change from one step to the next is booked as
/// `work_environment`. It must not depend on position, normal, tangents and slip.
struct SiteState {
  double time = 0;                          // at the end of the step [s]
  double temperature = room_temperature;    // at the end of the step [K]
  std::array<int, 2> objects{-1, -1};       // in the scene, of the site and of the other surface
  std::array<std::string_view, 2> names{};  // of these objects
  Vec3 rest_position = Vec3::Zero();        // of the site, as the scene places the mesh [m]
  Vec3 position = Vec3::Zero();             // of the site at the start of the step [m]
  Vec3 normal = Vec3::Zero();               // of the interface there, towards the site
  // Unit vectors along the interface, right-handed with the normal. The first one follows the first
  // edge of the opposite triangle, so components of slip along them are those of the material.
  std::array<Vec3, 2> tangents{Vec3::Zero(), Vec3::Zero()};
  Vec2 slip = Vec2::Zero();  // at the start of the step, along the tangents [m]
};

}  // namespace tack
