#include "geometry/level_set/polygon_distance.hpp"

#include <limits>

#include "geometry/level_set/distance_formulas.hpp"

namespace tack {

double polygon_distance(const Vec2& p, std::span<const Vec2> corners) {
  double distance = std::numeric_limits<double>::infinity();
  bool inside = false;
  for (size_t i = 0, j = corners.size() - 1; i < corners.size(); j = i++) {
    const Vec2 &a = corners[j], &b = corners[i];
    distance = std::min(distance, segment_distance(p, a, b));
    if ((a.y() > p.y()) != (b.y() > p.y()) && p.x() < a.x() + (p.y() - a.y()) / (b.y() - a.y()) * (b.x() - a.x())) inside = !inside;
  }
  return inside ? -distance : distance;
}

}  // namespace tack
