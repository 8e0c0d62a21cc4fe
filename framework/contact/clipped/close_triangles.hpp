// Which pairs of triangles can interact while their vertices move a little (clipped_pair.hpp).
//
// A point p of a lies over a point q of b at a gap up to the range, along the normal n of b. Undo a
// motion of vertices by m at most: p - q changes by 2 m at most and n by a bounded turn. So at the
// positions from which vertices moved, the gap and the projections onto the plane of b overlap up
// to 2 m plus the range times that turn.
#pragma once

#include <array>

#include "framework/contact/clipped/clip_plane.hpp"

namespace tack {

class CloseTriangles {
 public:
  explicit CloseTriangles(double motion) : motion_(motion) {}  // of vertices [m]

  // Returns false if the triangles do not interact at any positions of their vertices within the
  // motion of these. Corners counter-clockwise seen from outside; two_sided: the order of the
  // corners of one of them tells nothing. Keeps the plane of b for the next call.
  bool may_overlap(const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b, double range,
                   bool two_sided);

 private:
  double motion_;
  ClipPlane plane_;
  double turn_b_ = 0;  // bound of the change of the normal of b
};

}  // namespace tack
