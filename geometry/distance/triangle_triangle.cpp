#include "geometry/distance/triangle_triangle.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

using Corners = std::array<Vec3, 3>;

// Returns the distance of b from the plane of a; 0 if b does not lie on one side of it.
double from_plane(const Corners& a, const Corners& b) {
  const Vec3 normal = (a[1] - a[0]).cross(a[2] - a[0]);
  const double length = normal.norm();
  if (!(length > 0)) return 0;
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Vec3& p : b) {
    const double height = normal.dot(p - a[0]) / length;
    low = std::min(low, height);
    high = std::max(high, height);
  }
  return std::max({0.0, low, -high});
}

// The closest points are a corner and a face, or of two edges.
double squared_distance(const Corners& a, const Corners& b) {
  double least = std::numeric_limits<double>::infinity();
  for (int i = 0; i < 3; ++i) {
    least = std::min(least, point_triangle_distance(a[i], b[0], b[1], b[2]));
    least = std::min(least, point_triangle_distance(b[i], a[0], a[1], a[2]));
    for (int j = 0; j < 3; ++j) least = std::min(least, edge_edge_distance(a[i], a[(i + 1) % 3], b[j], b[(j + 1) % 3]));
  }
  return least;
}

}  // namespace

double triangles_apart(const Corners& a, const Corners& b, double enough) {
  const double by_boxes = box_gaps(a, b).cwiseMax(0.0).norm();
  if (by_boxes >= enough) return by_boxes;
  const double by_planes = std::max(from_plane(a, b), from_plane(b, a));
  if (by_planes >= enough) return by_planes;
  return std::sqrt(squared_distance(a, b));
}

}  // namespace tack
