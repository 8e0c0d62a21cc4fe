// Polygons that are cut by lines and levels, with derivatives. A node is a point (x, y) of the
// plane of a triangle with a gap g. Every cut makes nodes on the segments between two older nodes;
// the tape keeps how, so that one pass backwards takes the derivatives of a function of the newest
// nodes to the first ones and to the lines.
//
// A line runs through two points of the plane, with the inside on its left. A level is a gap.
#pragma once

#include <array>
#include <vector>

#include "geometry/types.hpp"

namespace tack {

struct ClipNode {
  Vec3 at;        // x, y, g [m]
  Vec3 slope;     // derivative of the integral by `at`
  int from = -1;  // ends of the segment that was cut; -1: a node of its own
  int to = -1;
  int line = -1;  // that cut it; -1: a level
  // A bit per line: the node is so near to it that round-off would decide on which side it lies.
  unsigned ties = 0;
  // A bit per line: the node is an end of an edge of the first triangle that lies along the line
  // and has a neighbour. What the cut adds to one of the two triangles there, it takes from the
  // other.
  unsigned shared_ties = 0;
  double t = 0;                       // at = (1 - t) from + t to
  double rate_from = 0, rate_to = 0;  // derivatives of t by the distances of both ends [1/m]
};

struct PlaneLine {
  Vec2 begin, end;              // m
  Vec2 inward;                  // unit normal to the left
  double length;                // m
  Vec2 slope_begin, slope_end;  // derivative of the integral by the two points

  PlaneLine() = default;
  PlaneLine(const Vec2& from, const Vec2& to);
  // Returns the distance of a point from the line, positive inside [m].
  double distance(const Vec3& at) const { return inward.dot(at.head<2>() - begin); }
  // Adds the derivative of the integral by the distance of a point: to the line's two points.
  // Returns the derivative by the point.
  Vec2 add_slope(const Vec3& at, double by_distance);
};

// A corner of a convex polygon. `side`: the edge of the first triangle on which the side lies that
// begins here; -1: none.
struct PieceCorner {
  int node, side;
};
// Corners in their order around the polygon.
using ClipPiece = std::vector<PieceCorner>;

// The tape of one pair of triangles. It keeps its memory from one pair to the next.
class ClipTape {
 public:
  std::vector<ClipNode> nodes;
  std::array<PlaneLine, 3> lines;

  void clear() { nodes.clear(); }
  int add(const Vec3& at) {
    nodes.push_back({at, Vec3::Zero()});
    return static_cast<int>(nodes.size()) - 1;
  }
  // Cuts a piece by a line of the second triangle and keeps what lies inside. Ties with the line
  // (ClipNode::ties) lie inside if `owns`. A shared tie is cut at the line even if it lies on the
  // other side of it: a sliver with a negative area then makes up for the neighbour's, and the sum
  // over both triangles is the exact one.
  void keep_inside(const ClipPiece& piece, int line, bool owns, ClipPiece& inside);
  // Cuts a piece where the distance from a line is `distance`. Overwrites `beyond` with the side of
  // larger distances and `within` with the other; a side of fewer than three corners is empty.
  // Nodes nearer to the cut than `tolerance` lie beyond it.
  void cut_by_line(const ClipPiece& piece, int line, double distance, double tolerance,
                   ClipPiece& beyond, ClipPiece& within);
  // Cuts a piece at a gap.
  void cut_by_level(const ClipPiece& piece, double level, ClipPiece& above, ClipPiece& below);
  // Passes the slopes of all nodes back to those without a segment, and to the lines.
  void pass_back();

 private:
  // Calls side(node): whether it lies beyond, and its distance from the cut, which is of that sign
  // or zero.
  template <class Side>
  void cut(const ClipPiece& piece, int line, const Side& side, ClipPiece& beyond,
           ClipPiece* within);
};

}  // namespace tack
