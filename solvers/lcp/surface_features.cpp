#include "solvers/lcp/surface_features.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>

#include "geometry/distance/closest_parameters.hpp"

namespace tack {
namespace {

// Sine of the angle between edges below which they count as parallel; point rows cover such pairs.
constexpr double parallel = 1e-3;

bool contains(const Triangle& t, int v) { return t[0] == v || t[1] == v || t[2] == v; }

// The corners of a triangle that carry the closest point, ascending.
NearPoint nearest_in(const CollisionMesh& mesh, int p, int t, const VecX& x) {
  const Triangle& v = mesh.triangles[t];
  const auto [a, b, c] = corners(x, v);
  const Vec3 q = vertex(x, p), l = point_triangle_barycentric(q, a, b, c);
  NearPoint near{p, t, 0, {-1, -1, -1}, {0, 0, 0}, 0, Vec3::Zero(), 0};
  for (int i = 0; i < 3; ++i)
    if (l[i] != 0) near.corners[near.count] = v[i], near.weights[near.count++] = l[i];
  const Vec3 difference = q - (l[0] * a + l[1] * b + l[2] * c);
  near.distance = difference.norm();
  near.normal = near.distance > 0 ? Vec3(difference / near.distance) : Vec3::Zero();
  return near;
}

}  // namespace

SurfaceFeatures::SurfaceFeatures(const ContactSurface& surface) : surface_(surface), topology_(surface), boundary_(surface.mesh.vertex_object.size(), 0) {
  const CollisionMesh& mesh = surface.mesh;
  std::map<Edge, std::vector<int>> at;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t)
    for (int i = 0; i < 3; ++i) {
      const auto [low, high] = std::minmax(mesh.triangles[t][i], mesh.triangles[t][(i + 1) % 3]);
      at[{low, high}].push_back(t);
    }
  edge_start_ = {0};
  for (const Edge& e : mesh.edges) {
    const auto [low, high] = std::minmax(e[0], e[1]);
    if (const auto found = at.find({low, high}); found != at.end())
      edge_triangles_.insert(edge_triangles_.end(), found->second.begin(), found->second.end());
    edge_start_.push_back(static_cast<int>(edge_triangles_.size()));
    if (edge_start_.back() - *(edge_start_.end() - 2) != 2) boundary_[e[0]] = boundary_[e[1]] = 1;
  }
}

Vec3 SurfaceFeatures::normal_of(int triangle, const VecX& x) const {
  const auto [a, b, c] = corners(x, surface_.mesh.triangles[triangle]);
  return (b - a).cross(c - a).normalized();
}

// Returns the number of triangles that share the nearest feature.
int SurfaceFeatures::triangles_at(const NearPoint& near) const {
  if (near.count == 3) return 1;
  const auto around = topology_.triangles_at(near.corners[0]);
  if (near.count == 1) return static_cast<int>(around.size());
  return static_cast<int>(std::count_if(around.begin(), around.end(), [&](int t) { return contains(surface_.mesh.triangles[t], near.corners[1]); }));
}

// Uses angle-weighted normals, whose sign tells inside from outside (Baerentzen and Aanaes 2005).
Vec3 SurfaceFeatures::normal_at(const NearPoint& near, const VecX& x) const {
  if (near.count == 3) return normal_of(near.triangle, x);
  Vec3 sum = Vec3::Zero();
  for (const int t : topology_.triangles_at(near.corners[0])) {
    const Triangle& v = surface_.mesh.triangles[t];
    if (near.count == 2) {
      if (contains(v, near.corners[1])) sum += normal_of(t, x);
      continue;
    }
    const int i = v[0] == near.corners[0] ? 0 : v[1] == near.corners[0] ? 1 : 2;
    const Vec3 o = vertex(x, v[i]), a = vertex(x, v[(i + 1) % 3]) - o, b = vertex(x, v[(i + 2) % 3]) - o;
    sum += std::atan2(a.cross(b).norm(), a.dot(b)) * normal_of(t, x);
  }
  return sum.normalized();
}

void SurfaceFeatures::near_point(const Candidates& candidates, int first, int last, const VecX& x, double search_radius, std::vector<NearPoint>& out) const {
  std::vector<NearPoint> group;
  for (int i = first; i < last; ++i) {
    const auto& [p, t] = candidates.point_triangle[i];
    NearPoint near = nearest_in(surface_.mesh, p, t, x);
    if (!(near.distance < search_radius)) continue;
    // Sorts corners, so that triangles give a shared feature the same key.
    for (int k = 1; k < near.count; ++k)
      for (int j = k; j > 0 && near.corners[j - 1] > near.corners[j]; --j)
        std::swap(near.corners[j - 1], near.corners[j]), std::swap(near.weights[j - 1], near.weights[j]);
    group.push_back(near);
  }
  // An edge or vertex is a local minimum only if all triangles around it agree.
  const auto key = [](const NearPoint& n) { return std::tuple(n.count, n.corners, n.triangle); };
  std::sort(group.begin(), group.end(), [&](const NearPoint& m, const NearPoint& n) { return key(m) < key(n); });
  for (size_t i = 0, end; i < group.size(); i = end) {
    NearPoint& near = group[i];
    for (end = i + 1; near.count < 3 && end < group.size() && group[end].count == near.count && group[end].corners == near.corners;) ++end;
    if (near.count < 3 && static_cast<int>(end - i) != triangles_at(near)) continue;
    bool boundary = near.count < 3;
    for (int k = 0; k < near.count; ++k) boundary = boundary && boundary_[near.corners[k]];
    if (near.count == 2 && boundary) boundary = triangles_at(near) != 2;
    if (!boundary) near.facing = near.normal.dot(normal_at(near, x));
    out.push_back(near);
  }
}

Vec3 SurfaceFeatures::normal_at_edge(int edge, const VecX& x) const {
  const auto triangles = triangles_at_edge(edge);
  if (triangles.size() != 2) return Vec3::Zero();
  return (normal_of(triangles[0], x) + normal_of(triangles[1], x)).normalized();
}

bool SurfaceFeatures::two_sided_at(int edge) const {
  for (const int t : triangles_at_edge(edge))
    if (surface_.two_sided[t]) return true;
  return false;
}

bool SurfaceFeatures::near_edges(int a, int b, const VecX& x, NearEdges& out) const {
  const auto [a0, a1] = corners(x, surface_.mesh.edges[a]);
  const auto [b0, b1] = corners(x, surface_.mesh.edges[b]);
  const Vec3 across = (a1 - a0).cross(b1 - b0);
  if (across.norm() <= parallel * (a1 - a0).norm() * (b1 - b0).norm() || edge_edge_type(a0, a1, b0, b1) != EdgeEdgeType::EA_EB) return false;
  out.a = a;
  out.b = b;
  out.at = edge_edge_parameters(a0, a1, b0, b1, EdgeEdgeType::EA_EB);
  const Vec3 difference = (1 - out.at[0]) * a0 + out.at[0] * a1 - (1 - out.at[1]) * b0 - out.at[1] * b1;
  out.distance = difference.norm();
  // The sign of the distance vector may be lost to rounding; the line across both edges is not.
  const Vec3 line = across.normalized();
  out.normal = line.dot(difference) < 0 ? Vec3(-line) : line;
  out.facing_a = -out.normal.dot(normal_at_edge(a, x));
  out.facing_b = out.normal.dot(normal_at_edge(b, x));
  return true;
}

}  // namespace tack
