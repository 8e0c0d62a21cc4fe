// Scenes of something that falls on a floor.
#pragma once

#include <string>

namespace tack {

// A step of 10 ms in which the objects (the entries of a list, indented by two) may meet a floor,
// whose upper side is at y = 0; then further sections, `contact` among them.
inline std::string step_on_floor(const std::string& objects_and_more) {
  return "time: {step: 0.01, duration: 0.01}\n"
         "gravity: [0, -9.81, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.2, 1]}, place: {translate: [0, -0.1, "
         "0]}, motion: [fixed]}\n" +
         objects_and_more;
}

}  // namespace tack
