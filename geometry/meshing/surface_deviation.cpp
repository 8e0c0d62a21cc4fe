#include "geometry/meshing/surface_deviation.hpp"

#include <CGAL/AABB_traits.h>
#include <CGAL/AABB_tree.h>
#include <CGAL/AABB_triangle_primitive.h>

#include <algorithm>
#include <cmath>

#include "geometry/mesh/quality.hpp"
#include "geometry/meshing/cgal_mesh.hpp"

namespace tack {
namespace {

using Triangles = std::vector<CgalKernel::Triangle_3>;
using Primitive = CGAL::AABB_triangle_primitive<CgalKernel, Triangles::const_iterator>;
using Tree = CGAL::AABB_tree<CGAL::AABB_traits<CgalKernel, Primitive>>;

}  // namespace

SurfaceDeviation surface_deviation(const Mesh& from, const Mesh& to, double spacing) {
  Triangles triangles;
  for (const auto& [a, b, c] : to.triangles)
    triangles.emplace_back(cgal_point(to.vertices[a]), cgal_point(to.vertices[b]), cgal_point(to.vertices[c]));
  Tree tree(triangles.begin(), triangles.end());
  tree.accelerate_distance_queries();
  SurfaceDeviation found;
  double square = 0, area = 0;
  const auto distance_at = [&](const Vec3& x) {
    const double d = std::sqrt(tree.squared_distance(cgal_point(x)));
    if (d > found.largest) found.largest = d, found.position = x;
    return d;
  };
  for (const auto& [ia, ib, ic] : from.triangles) {
    const Vec3 &a = from.vertices[ia], &b = from.vertices[ib], &c = from.vertices[ic];
    const double longest = std::max({(b - a).norm(), (c - b).norm(), (a - c).norm()});
    const int n = static_cast<int>(std::clamp(std::ceil(longest / spacing), 1.0, 64.0));
    for (const Vec3* corner : {&a, &b, &c}) distance_at(*corner);
    // Centroids of n^2 triangles of equal area.
    double sum = 0;
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < n - i; ++j)
        for (const double up : {1.0 / 3, 2.0 / 3}) {
          const double u = (i + up) / n, v = (j + up) / n;
          if (u + v >= 1) continue;
          const double d = distance_at(a + u * (b - a) + v * (c - a));
          sum += d * d;
        }
    const double size = triangle_area(a, b, c);
    square += sum / (n * n) * size;
    area += size;
  }
  found.rms = area > 0 ? std::sqrt(square / area) : 0;
  return found;
}

}  // namespace tack
