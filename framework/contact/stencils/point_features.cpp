#include "framework/contact/stencils/point_features.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

PointFeature face(const Triangle& t) {
  PointFeature f{t, 1};
  std::sort(f.vertices.begin(), f.vertices.end());
  return f;
}

PointFeature edge_feature(int a, int b, double multiplicity) {
  return {{std::min(a, b), std::max(a, b), -1}, multiplicity};
}

PointFeature closest_feature(const Triangle& t, PointTriangleType type) {
  switch (type) {
    case PointTriangleType::P_T0: return {{t[0], -1, -1}, 1};
    case PointTriangleType::P_T1: return {{t[1], -1, -1}, 1};
    case PointTriangleType::P_T2: return {{t[2], -1, -1}, 1};
    case PointTriangleType::P_E0: return edge_feature(t[0], t[1], 1);
    case PointTriangleType::P_E1: return edge_feature(t[1], t[2], 1);
    case PointTriangleType::P_E2: return edge_feature(t[2], t[0], 1);
    case PointTriangleType::P_T: break;
  }
  return face(t);
}

}  // namespace

PointFeature closest_feature(const VecX& x, const Vec3& p, const Triangle& t) {
  const auto [a, b, c] = corners(x, t);
  return closest_feature(t, point_triangle_type(p, a, b, c));
}

bool PointFeatures::add_triangle(const VecX& x, const Vec3& p, const Triangle& t,
                                 double range_squared) {
  const auto c = corners(x, t);
  const double box_gap = box_gaps(std::array{p}, c).maxCoeff();
  if (box_gap > 0 && box_gap * box_gap >= range_squared) return false;
  const PointTriangleType type = point_triangle_type(p, c[0], c[1], c[2]);
  if (!(point_triangle_distance(p, c[0], c[1], c[2], type) < range_squared)) return false;
  features_.push_back(closest_feature(t, type));
  return true;
}

void PointFeatures::add_edge(const VecX& x, const Vec3& p, const Edge& e, double multiplicity,
                             double range_squared) {
  const PointEdgeClosest closest = point_edge_closest(p, vertex(x, e[0]), vertex(x, e[1]));
  if (!(closest.s < range_squared)) return;
  switch (closest.type) {
    case PointEdgeType::P_E0: features_.push_back({{e[0], -1, -1}, multiplicity}); break;
    case PointEdgeType::P_E1: features_.push_back({{e[1], -1, -1}, multiplicity}); break;
    case PointEdgeType::P_E: features_.push_back(edge_feature(e[0], e[1], multiplicity)); break;
  }
}

// Appends the terms of shared edges and vertices of the primitives within range.
void PointFeatures::subtract_shared(const VecX& x, const Vec3& p, double range_squared) {
  std::sort(edge_uses_.begin(), edge_uses_.end(),
            [](const EdgeUse& a, const EdgeUse& b) { return a.edge < b.edge; });
  for (size_t i = 0; i < edge_uses_.size();) {
    size_t end = i;
    int triangles = 0;
    for (; end < edge_uses_.size() && edge_uses_[end].edge == edge_uses_[i].edge; ++end)
      triangles += edge_uses_[end].triangles;
    const Edge edge = edge_uses_[i].edge;
    i = end;
    if (triangles == 1) continue;
    if (triangles > 1) add_edge(x, p, edge, 1 - triangles, range_squared);
    for (const int v : edge) vertex_uses_.push_back({v, triangles - 1});
  }
  std::sort(vertex_uses_.begin(), vertex_uses_.end(),
            [](const VertexUse& a, const VertexUse& b) { return a.vertex < b.vertex; });
  for (size_t i = 0; i < vertex_uses_.size();) {
    const int v = vertex_uses_[i].vertex;
    int coefficient = 1;
    for (; i < vertex_uses_.size() && vertex_uses_[i].vertex == v; ++i)
      coefficient += vertex_uses_[i].coefficient;
    if (coefficient != 0 && (p - vertex(x, v)).squaredNorm() < range_squared)
      features_.push_back({{v, -1, -1}, static_cast<double>(coefficient)});
  }
}

void PointFeatures::merge() {
  if (features_.size() < 2) return;
  std::sort(features_.begin(), features_.end(), [](const PointFeature& a, const PointFeature& b) {
    return a.vertices < b.vertices;
  });
  size_t kept = 0;
  for (size_t i = 0; i < features_.size();) {
    PointFeature sum = features_[i];
    for (++i; i < features_.size() && features_[i].vertices == sum.vertices; ++i)
      sum.multiplicity += features_[i].multiplicity;
    if (std::abs(sum.multiplicity) > multiplicity_rounding) features_[kept++] = sum;
  }
  features_.resize(kept);
}

const std::vector<PointFeature>& PointFeatures::reduce(const VecX& x, const Vec3& p,
                                                       std::span<const Triangle> triangles,
                                                       std::span<const Edge> edges,
                                                       std::span<const int> vertices, double range,
                                                       FeatureCount count) {
  features_.clear();
  edge_uses_.clear();
  vertex_uses_.clear();
  const double range_squared = range * range;
  int close_triangles = 0;
  for (const Triangle& t : triangles) {
    if (!add_triangle(x, p, t, range_squared)) continue;
    ++close_triangles;
    for (int i = 0; i < 3; ++i) {
      const int a = t[i], b = t[(i + 1) % 3];
      edge_uses_.push_back({{std::min(a, b), std::max(a, b)}, 1});
      vertex_uses_.push_back({a, -1});
    }
  }
  for (const Edge& e : edges) {
    add_edge(x, p, e, 1, range_squared);
    edge_uses_.push_back({{std::min(e[0], e[1]), std::max(e[0], e[1])}, 0});
  }
  for (const int v : vertices)
    if ((p - vertex(x, v)).squaredNorm() < range_squared) features_.push_back({{v, -1, -1}, 1});
  const bool overlaps = close_triangles + edges.size() > 1;
  if (overlaps && count == FeatureCount::inclusion_exclusion) subtract_shared(x, p, range_squared);
  merge();
  return features_;
}

}  // namespace tack
