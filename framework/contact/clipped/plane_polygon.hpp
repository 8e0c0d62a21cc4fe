// Convex polygons in the plane of triangle b (clipped_pair.hpp) that are cut by lines and at gaps.
// A corner carries what is affine over triangle a: the gap and the barycentric coordinates.
#pragma once

#include <array>

namespace tack {

// Which curve a side of a polygon lies on: 0 to 2: an edge of a; 3 to 5: a line of b.
struct PlaneSide {
  static constexpr int line_of_b = 3;
  static constexpr int level = 6;     // a gap at which the law changes
  static constexpr int interior = 7;  // a cut that moves nothing
};

struct PlaneCorner {
  double x, y, gap;             // m
  std::array<double, 3> share;  // barycentric coordinates in a
  int side;                     // curve of the side that begins here
  // Bits per line of b: the corner is so near to it that round-off would decide on which side it
  // lies; it is an end of an edge of a that lies along the line.
  unsigned ties, along;
};

// Corners in their order around the polygon, counter-clockwise.
class PlanePolygon {
 public:
  // A triangle has 6 corners at most after three cuts by lines, and each later cut adds one. Only
  // round-off on a sliver could add more, which are dropped.
  static constexpr int capacity = 20;

  PlanePolygon() = default;
  PlanePolygon(const PlanePolygon& other) { *this = other; }
  PlanePolygon& operator=(const PlanePolygon& other) {
    size_ = other.size_;
    for (int i = 0; i < size_; ++i) corners_[i] = other.corners_[i];
    return *this;
  }

  int size() const { return size_; }
  bool empty() const { return size_ == 0; }
  const PlaneCorner& operator[](int i) const { return corners_[i]; }
  PlaneCorner& operator[](int i) { return corners_[i]; }
  // Returns the corner after corner i.
  const PlaneCorner& after(int i) const { return corners_[i + 1 < size_ ? i + 1 : 0]; }
  void clear() { size_ = 0; }
  void add(const PlaneCorner& corner) {
    if (size_ < capacity) corners_[size_++] = corner;
  }

 private:
  int size_ = 0;
  std::array<PlaneCorner, capacity> corners_;
};

// Cuts a polygon by a curve that is a line in the plane. distance[i]: of corner i, up to a factor;
// beyond[i]: whether corner i counts as on the side of positive distances. Where that is not the
// sign of the distance, the side between two corners is prolonged up to the curve. Overwrites
// `kept` with that side of the polygon, and `rest`, unless null, with the other; a side of fewer
// than three corners is empty. New sides lie on `curve`.
void cut_polygon(const PlanePolygon& polygon, const double* distance, const bool* beyond, int curve,
                 PlanePolygon& kept, PlanePolygon* rest);

}  // namespace tack
