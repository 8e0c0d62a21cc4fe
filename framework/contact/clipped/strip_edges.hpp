// Edges of triangles along which the clipped integral may have a strip (boundary_weight.hpp): every
// edge of the surface, as any may be a boundary, a crease or a region interface.
//
// Limits of the width. Strips stay in the inner half of their triangle. And a strip lies in the
// triangle of its edge alone, so it lacks what lies beyond an interior edge there: a corner of
// length width / tan(angle). An overlap that takes only this corner loses up to 0.05 of the width
// times its length, so the corner is made no longer than the largest width.
#pragma once

#include <array>
#include <vector>

#include "framework/contact/surface/surface_topology.hpp"

namespace tack {

class StripEdges {
 public:
  StripEdges(const ContactSurface& surface, const SurfaceTopology& topology);

  // Edge k of a triangle runs from its corner k to the next.

  // Returns the triangle beyond a smooth edge; -1 at a boundary or crease.
  int neighbour(int triangle, int k) const { return neighbour_[triangle][k]; }
  bool smooth(int triangle, int k) const { return neighbour(triangle, k) >= 0; }
  // Returns the width of a strip along an edge; width_max: of any strip [m].
  double width(int triangle, int k, double width_max) const {
    return std::min(half_height_[triangle][k], width_max * ratio_[triangle][k]);
  }

 private:
  std::vector<std::array<int, 3>> neighbour_;
  std::vector<std::array<double, 3>> half_height_;  // at rest [m]
  std::vector<std::array<double, 3>> ratio_;  // bound of the width for its corners, per width_max
};

}  // namespace tack
