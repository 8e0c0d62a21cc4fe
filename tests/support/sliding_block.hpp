// A block that slides, turns and sticks on a floor, bonds to it and is damped: history of every
// kind within a few steps of 2 ms.
#pragma once

namespace tack {

// Objects and contact of the scene.
inline constexpr const char* sliding_block = R"(
gravity: [0, -9.81, 0]
objects:
  - {name: floor, shape: {type: box, size: [1, 0.02, 0.5]}, motion: [fixed],
     place: {translate: [0, -0.01, 0]}}
  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]},
     place: {translate: [0, 0.052, 0]}, velocity: [0.4, -0.5, 0.1], damping: {stiffness: 0.2 ms},
     energies: [{type: neo_hookean, young: 1e5}]}
contact: {distance: 1 mm, friction: {mu: 0.3},
  pairs: [{between: [block, floor], bond: on_contact,
    adhesion: {type: bilinear, peak_traction: 1 kPa, work_of_adhesion: 0.2 J/m^2}}]}
)";

}  // namespace tack
