#include "geometry/exact/orientation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <tbb/blocked_range.h>
#include <tbb/parallel_reduce.h>

#include <algorithm>

namespace tack {
namespace {

using Point = CGAL::Exact_predicates_inexact_constructions_kernel::Point_3;

bool positive_volume(const Tet& tet, const VecX& x) {
  std::array<Point, 4> points;
  for (int k = 0; k < 4; ++k) {
    const Vec3 v = vertex(x, tet[k]);
    if (!v.allFinite()) return false;
    points[k] = Point(v[0], v[1], v[2]);
  }
  return CGAL::orientation(points[0], points[1], points[2], points[3]) == CGAL::POSITIVE;
}

}  // namespace

int first_inverted_tet(const std::vector<Tet>& tets, const VecX& x) {
  using Range = tbb::blocked_range<int>;
  const int count = static_cast<int>(tets.size());
  const int first = tbb::parallel_reduce(
      Range(0, count, 1024), count,
      [&](const Range& range, int lowest) {
        for (int i = range.begin(); i < std::min(range.end(), lowest); ++i)
          if (!positive_volume(tets[i], x)) return i;
        return lowest;
      },
      [](int a, int b) { return std::min(a, b); });
  return first == count ? -1 : first;
}

}  // namespace tack
