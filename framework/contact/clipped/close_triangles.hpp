// Which pairs of triangles can interact while their vertices move a little (clipped_pair.hpp),
// several pairs side by side.
//
// A point p of a lies over a point q of b at a gap up to the range, along the normal n of b. Undo a
// motion of vertices by m at most: p - q changes by 2 m at most and n by a bounded turn. So at the
// positions from which vertices moved, the gap and the projections onto the plane of b overlap up
// to 2 m plus the range times that turn.
#pragma once

#include <array>

#include "geometry/pack.hpp"
#include "geometry/types.hpp"

namespace tack {

class CloseTriangles {
 public:
  explicit CloseTriangles(double motion) : motion_(motion) {}  // of vertices [m]

  // vertices: of the corners of a, then of b, in the positions x (3n) [m], counter-clockwise seen
  // from outside; range: of the law [m]; two_sided: the order of the corners of one of the
  // triangles tells nothing.
  void set(int lane, const VecX& x, const std::array<int, 6>& vertices, double range,
           bool two_sided);
  // A bit per lane.
  struct Lanes {
    unsigned close = 0;  // 0: the triangles do not interact within the motion of their vertices
    unsigned inside =
        0;  // 1: a lies over the inside of b now, farther from its edges than they move
  };
  Lanes test() const;

 private:
  double motion_;
  alignas(64) double corner_[18][pack_width] = {};
  alignas(64) double range_[pack_width] = {}, two_sided_[pack_width] = {};
};

}  // namespace tack
