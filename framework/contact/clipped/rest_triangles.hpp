// Triangles of one object that do not adhere to each other.
#pragma once

#include <utility>
#include <vector>

#include "framework/contact/stencils/contact_set.hpp"

namespace tack {

// Returns whether two triangles of one object share a vertex, or have vertices or edges that are
// neighbours at rest (rest_neighbours.hpp) within range [m].
bool neighbours_at_rest(const ContactSurface& surface, int a, int b, double range);

// The same, found once per pair: fifteen distances of primitives are dear, and the same pairs of
// triangles are asked for whenever the candidates change.
class RestTriangles {
 public:
  // The surface must outlive this.
  explicit RestTriangles(const ContactSurface& surface)
      : surface_(surface), known_(surface.mesh.triangles.size()) {}

  // Returns neighbours_at_rest(a, b, range); range: of the one law of the pair. Several threads may
  // ask at once, each for triangles b of its own.
  bool neighbours(int a, int b, double range);

 private:
  const ContactSurface& surface_;
  std::vector<std::vector<std::pair<int, bool>>> known_;  // per b: answers, ascending by a
};

}  // namespace tack
