#include "framework/bond/bond_attachment.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr int crossings_max = 64;  // edges from the opposite triangle to the one that is faced
constexpr double outside = 1e-6;   // barycentric coordinates below minus this: p is outside

// Returns the other triangle at edge i of a triangle, from its corner i to the next; -1: none.
int across_edge(const SurfaceTopology& topology, const CollisionMesh& mesh, int triangle, int i) {
  const Triangle& t = mesh.triangles[triangle];
  const int u = t[i], v = t[(i + 1) % 3];
  for (const int other : topology.triangles_at(u)) {
    const Triangle& o = mesh.triangles[other];
    if (other != triangle && std::find(o.begin(), o.end(), v) != o.end()) return other;
  }
  return -1;
}

// Returns the barycentric coordinates of the projection of p onto the plane of a triangle.
Vec3 coordinates_of(const CollisionMesh& mesh, const VecX& x, int triangle, const Vec3& p) {
  const auto [a, b, c] = corners(x, mesh.triangles[triangle]);
  const Vec3 n = (b - a).cross(c - a);
  const double squared = n.squaredNorm();
  const double v = (p - a).cross(c - a).dot(n) / squared, w = (b - a).cross(p - a).dot(n) / squared;
  return {1 - v - w, v, w};
}

}  // namespace

std::optional<int> facing_triangle(const SurfaceTopology& topology, const CollisionMesh& mesh, const VecX& x, int from, const Vec3& p) {
  int triangle = from, before = -1;
  for (int k = 0; k < crossings_max; ++k) {
    const Vec3 c = coordinates_of(mesh, x, triangle, p);
    int farthest;
    if (c.minCoeff(&farthest) >= -outside) return triangle;
    const int edge = (farthest + 1) % 3;  // opposite that corner
    if (!topology.smooth_edge(triangle, edge)) return std::nullopt;
    const int next = across_edge(topology, mesh, triangle, edge);
    if (next == before) return triangle;  // over a ridge, p is beyond either side of it
    before = triangle;
    triangle = next;
  }
  return std::nullopt;
}

Vec3 site_position(const Bond& bond, const VecX& x) {
  Vec3 p = Vec3::Zero();
  for (int i = 0; i < bond.site_count; ++i) p += bond.c[i] * vertex(x, bond.vertices[i]);
  return p;
}

void move_attachment(Bond& bond, const SurfaceTopology& topology, const CollisionMesh& mesh, const VecX& x, double kept) {
  const Opening o = opening_of(bond, x);
  const Vec3 p = site_position(bond, x);
  // The interface point of the opposite side, moved towards that of the site.
  Vec3 point = bond.lever[1] * bond.normals[1] + (1 - kept) * (o.u + std::max(o.d, 0.0) * bond.normal);
  for (int i = bond.site_count; i < bond.count(); ++i) point -= bond.c[i] * vertex(x, bond.vertices[i]);
  bond.opposite_triangle = facing_triangle(topology, mesh, x, bond.opposite_triangle, point).value_or(bond.opposite_triangle);
  const Vec3 c = coordinates_of(mesh, x, bond.opposite_triangle, point);
  for (int i = 0; i < 3; ++i) {
    bond.vertices[bond.site_count + i] = mesh.triangles[bond.opposite_triangle][i];
    bond.c[bond.site_count + i] = -c[i];
  }
  const auto [t0, t1, t2] = corners(x, mesh.triangles[bond.opposite_triangle]);
  const Vec3 n = bond.side[1] * (t1 - t0).cross(t2 - t0).normalized();
  bond.lever[1] = n.dot(point - t0);
  bond.rest = n.dot(p - t0) - (o.d > 0 ? kept * o.d : o.d);
}

}  // namespace tack
