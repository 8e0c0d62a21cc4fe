// A scene of 16 vertices for tests of the whole program: a sticky block that lies on a floor.
#pragma once

#include <stdexcept>
#include <string>

namespace tack {

inline const std::string tiny_scene = R"(name: tiny
time: {step: 0.01 s, duration: 0.05 s}
gravity: [0, -9.81, 0]
objects:
  - name: floor
    shape: {type: box, size: [1, 0.2, 1]}
    place: {translate: [0, -0.1, 0]}
    motion: [fixed]
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2]}
    place: {translate: [0, 0.1006, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]
contact:
  distance: 1 mm
  pairs:
    - between: [block, floor]
      adhesion: {type: fang, critical_strain: 0.001}
probes:
  - {name: height, type: centre_of_mass, object: block, direction: [0, 1, 0]}
  - {name: stickiness, type: contact_force, on: block, from: floor, part: adhesion}
expect:
  - {probe: height, statistic: min, at_least: 0.09}
)";

// The tiny scene with one part of it, which must occur just once, replaced.
inline std::string tiny_scene_with(const std::string& part, const std::string& other) {
  std::string text = tiny_scene;
  const size_t at = text.find(part);
  if (at == std::string::npos || text.find(part, at + 1) != std::string::npos)
    throw std::logic_error("not once in the tiny scene: " + part);
  return text.replace(at, part.size(), other);
}

}  // namespace tack
