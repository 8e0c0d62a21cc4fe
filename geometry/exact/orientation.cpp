#include "geometry/exact/orientation.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>

#include <algorithm>
#include <vector>

#include "geometry/parallel.hpp"

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

Point point_of(const Vec3& v) { return {v[0], v[1], v[2]}; }

}  // namespace

bool tet_contains(const Tet& tet, const VecX& x, const Vec3& point) {
  constexpr std::array<Triangle, 4> inward = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
  const Point p = point_of(point);
  return std::all_of(inward.begin(), inward.end(), [&](const Triangle& f) {
    const Point a = point_of(vertex(x, tet[f[0]])), b = point_of(vertex(x, tet[f[1]])),
                c = point_of(vertex(x, tet[f[2]]));
    return CGAL::orientation(a, b, c, p) != CGAL::NEGATIVE;
  });
}

int first_inverted_tet(const std::vector<Tet>& tets, const VecX& x) {
  constexpr int tets_per_chunk = 1024;
  const int count = static_cast<int>(tets.size());
  std::vector<int> inverted(chunk_count(count, tets_per_chunk), -1);  // first one of each chunk
  for_each_chunk(count, [&](int chunk, int begin, int end) {
    for (int i = begin; i < end && inverted[chunk] < 0; ++i)
      if (!positive_volume(tets[i], x)) inverted[chunk] = i;
  }, tets_per_chunk);
  const auto first = std::find_if(inverted.begin(), inverted.end(), [](int i) { return i >= 0; });
  return first == inverted.end() ? -1 : *first;
}

}  // namespace tack
