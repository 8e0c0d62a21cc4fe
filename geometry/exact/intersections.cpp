#include "geometry/exact/intersections.hpp"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <fmt/core.h>

#include <algorithm>

#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/broad_phase/primitives.hpp"
#include "geometry/errors.hpp"
#include "geometry/exact/separating_axis.hpp"

namespace tack {
namespace {

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Point = Kernel::Point_3;
using Segment = Kernel::Segment_3;

Point point(const Vec3& v) { return {v[0], v[1], v[2]}; }

bool segments_meet(const Point& p, const Point& q, const Point& a, const Point& b) {
  if (p == q) return a == b ? p == a : Segment(a, b).has_on(p);
  return a == b ? Segment(p, q).has_on(a) : CGAL::do_intersect(Segment(p, q), Segment(a, b));
}

bool segment_meets_triangle(const Vec3& p_, const Vec3& q_, const Vec3& a_, const Vec3& b_,
                            const Vec3& c_) {
  if (certainly_disjoint(p_, q_, a_, b_, c_)) return false;
  const Point p = point(p_), q = point(q_), a = point(a_), b = point(b_), c = point(c_);
  if (CGAL::collinear(a, b, c))
    return segments_meet(p, q, a, b) || segments_meet(p, q, b, c) || segments_meet(p, q, c, a);
  const Kernel::Triangle_3 triangle(a, b, c);
  return p == q ? triangle.has_on(p) : CGAL::do_intersect(triangle, Segment(p, q));
}

// The relation of overlap_pairs: edges are the queries.
struct EdgeMeetsTriangle {
  const Primitives<2>& edges;
  const Primitives<3>& triangles;
  const CollidingObjects& colliding;
  const VecX& x;

  bool accept(int e, int t) const {
    const auto& [p, q] = edges.vertices[e];
    const auto& [a, b, c] = triangles.vertices[t];
    return !share_vertex(edges.vertices[e], triangles.vertices[t]) &&
           colliding.allows(edges.objects[e], triangles.objects[t]) &&
           segment_meets_triangle(vertex(x, p), vertex(x, q), vertex(x, a), vertex(x, b),
                                  vertex(x, c));
  }
  std::array<int, 2> pair(int e, int t) const { return {e, t}; }
};

template <std::size_t N>
Primitives<N> collect(const std::vector<std::array<int, N>>& all, const CollisionMesh& mesh,
                      const std::vector<Aabb>& vertex_boxes, bool movable_only) {
  Primitives<N> primitives;
  for (std::size_t i = 0; i < all.size(); ++i) primitives.add(all[i], static_cast<int>(i), mesh);
  if (!movable_only) primitives.movable.assign(all.size(), 1);
  primitives.refresh_tree(vertex_boxes, {});
  return primitives;
}

std::vector<Aabb> vertex_boxes(const CollisionMesh& mesh, const VecX& x) {
  std::vector<Aabb> boxes(mesh.vertex_object.size());
  if (x.size() < 3 * static_cast<Eigen::Index>(boxes.size()))
    throw InputError(fmt::format("intersection check: {} coordinates for {} vertices; give 3 each",
                                 x.size(), boxes.size()));
  for (const int v : mesh.vertices) {
    if (!vertex(x, v).allFinite())
      throw SimulationError(fmt::format(
          "intersection check: the position of vertex {} is not finite; the solve diverged", v));
    boxes[v].include(Vec3(vertex(x, v)));
  }
  return boxes;
}

}  // namespace

std::vector<EdgeTriangleHit> find_intersections(const CollisionMesh& mesh, const VecX& x,
                                                const CollidingObjects& colliding, int max_hits,
                                                bool movable_only) {
  const std::vector<Aabb> boxes = vertex_boxes(mesh, x);
  const auto edges = collect(mesh.edges, mesh, boxes, movable_only);
  const auto triangles = collect(mesh.triangles, mesh, boxes, movable_only);
  std::vector<std::array<int, 2>> pairs;
  overlap_pairs(edges.tree, triangles.tree, EdgeMeetsTriangle{edges, triangles, colliding, x}, pairs);
  const auto count = std::min(pairs.size(), static_cast<std::size_t>(std::max(max_hits, 0)));
  std::vector<EdgeTriangleHit> hits;
  for (std::size_t i = 0; i < count; ++i) hits.push_back({pairs[i][0], pairs[i][1]});
  return hits;
}

}  // namespace tack
