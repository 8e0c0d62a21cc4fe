#include "framework/contact/contact_set.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {

Candidates candidates_between(const CollisionMesh& mesh, const Candidates& candidates, int a, int b) {
  Candidates found;
  found.reference = candidates.reference;
  const auto keep = [&](auto list, auto clearance, const auto& first_of, const auto& second_of) {
    for (size_t k = 0; k < (candidates.*list).size(); ++k) {
      const auto& pair = (candidates.*list)[k];
      const int i = mesh.vertex_object[first_of(pair[0])], j = mesh.vertex_object[second_of(pair[1])];
      if (!((i == a && j == b) || (i == b && j == a))) continue;
      (found.*list).push_back(pair);
      (found.clearances.*clearance).push_back((candidates.clearances.*clearance)[k]);
      (found.distances.*clearance).push_back((candidates.distances.*clearance)[k]);
    }
  };
  const auto self = [](int v) { return v; };
  const auto edge = [&](int e) { return mesh.edges[e][0]; };
  const auto triangle = [&](int t) { return mesh.triangles[t][0]; };
  keep(&Candidates::point_triangle, &Clearances::point_triangle, self, triangle);
  keep(&Candidates::edge_edge, &Clearances::edge_edge, edge, edge);
  keep(&Candidates::point_edge, &Clearances::point_edge, self, edge);
  keep(&Candidates::point_point, &Clearances::point_point, self, self);
  return found;
}

double smallest_gap(const CollisionMesh& mesh, const PairTable& pairs, const Candidates& candidates, const VecX& x) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  const auto smallest = [&](const auto& list, const auto& clearance, const auto& offset, const auto& squared) {
    return min_chunks(static_cast<int>(list.size()), infinity, [&](int first, int last) {
      double least = infinity;
      for (int i = first; i < last; ++i) {
        const double filled = pairs.largest_offset() > 0 ? offset(list[i][0], list[i][1]) : 0;
        if (clearance[i] - filled < least) least = std::min(least, std::sqrt(squared(list[i][0], list[i][1])) - filled);
      }
      return least;
    });
  };
  const auto at = [&](int v) { return Vec3(vertex(x, v)); };
  const auto offset = [&](int v, int w) { return pairs.offset(mesh.vertex_object[v], mesh.vertex_object[w]); };
  const Clearances& clearances = candidates.clearances;
  const double points = smallest(
      candidates.point_triangle, clearances.point_triangle, [&](int p, int t) { return offset(p, mesh.triangles[t][0]); },
      [&](int p, int t) {
        const Triangle& f = mesh.triangles[t];
        return point_triangle_distance(at(p), at(f[0]), at(f[1]), at(f[2]));
      });
  const double edges = smallest(
      candidates.edge_edge, clearances.edge_edge, [&](int i, int j) { return offset(mesh.edges[i][0], mesh.edges[j][0]); },
      [&](int i, int j) {
        const Edge &a = mesh.edges[i], &b = mesh.edges[j];
        return edge_edge_distance(at(a[0]), at(a[1]), at(b[0]), at(b[1]));
      });
  const double rods = smallest(
      candidates.point_edge, clearances.point_edge, [&](int p, int e) { return offset(p, mesh.edges[e][0]); },
      [&](int p, int e) { return point_edge_closest(at(p), at(mesh.edges[e][0]), at(mesh.edges[e][1])).s; });
  const double particles = smallest(candidates.point_point, clearances.point_point, offset,
                                    [&](int a, int b) { return (at(a) - at(b)).squaredNorm(); });
  return std::min({points, edges, rods, particles});
}

}  // namespace tack
