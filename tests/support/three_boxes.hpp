// Three small boxes around each other, askew; between a and b all edges are nearly parallel.
#pragma once

#include <fmt/format.h>

#include <string>

namespace tack {

// The `objects` of a scene: boxes a, b and c of 0.1 m, with this many cells a side.
inline std::string three_boxes(int cells = 2) {
  const std::string material = "energies: [{type: neo_hookean, young: 1e5}]";
  const std::string shape =
      fmt::format("shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [{0}, {0}, {0}]}}", cells);
  return "objects:\n"
         "  - {name: a, " +
         shape + ", " + material +
         "}\n"
         "  - {name: b, " +
         shape +
         ", place: {axis: [0.3, 1, 0.2], angle: 0.012, translate: [0.013, 0.112, 0.017]}, " +
         material +
         "}\n"
         "  - {name: c, " +
         shape + ", place: {axis: [1, 0.4, 0.7], angle: 1.1, translate: [0.158, 0.04, 0.02]}, " +
         material + "}\n";
}

}  // namespace tack
