#include "framework/contact/clipped/rest_triangles.hpp"

#include <algorithm>

#include "framework/contact/stencils/rest_neighbours.hpp"

namespace tack {
namespace {

// Returns an edge with its vertices ascending.
Edge edge_of(const Triangle& t, int side) {
  const auto [first, last] = std::minmax(t[side], t[(side + 1) % 3]);
  return {first, last};
}

}  // namespace

bool neighbours_at_rest(const ContactSurface& surface, int a, int b, double range) {
  const Triangle &ta = surface.mesh.triangles[a], &tb = surface.mesh.triangles[b];
  for (const int v : ta)
    if (std::find(tb.begin(), tb.end(), v) != tb.end()) return true;
  if (box_gaps(corners(surface.rest, ta), corners(surface.rest, tb)).maxCoeff() >= range) return false;
  for (int k = 0; k < 3; ++k) {
    if (rest_neighbours(surface, std::array{ta[k]}, tb, range) || rest_neighbours(surface, std::array{tb[k]}, ta, range)) return true;
    for (int m = 0; m < 3; ++m)
      if (rest_neighbours(surface, edge_of(ta, k), edge_of(tb, m), range)) return true;
  }
  return false;
}

bool RestTriangles::neighbours(int a, int b, double range) {
  auto& known = known_[b];
  const auto at = std::lower_bound(known.begin(), known.end(), a, [](const auto& answer, int wanted) { return answer.first < wanted; });
  if (at != known.end() && at->first == a) return at->second;
  const bool found = neighbours_at_rest(surface_, a, b, range);
  known.insert(at, {a, found});
  return found;
}

}  // namespace tack
