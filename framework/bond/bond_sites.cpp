#include "framework/bond/bond_sites.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "framework/contact/points/contact_points.hpp"
#include "framework/contact/contact_potential.hpp"
#include "framework/contact/surface/lagged_surface.hpp"
#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr double rounding = 1e-9;  // of the distance: surfaces may be placed just so far apart

void add_triangles(const ContactSystem& system, const BondTable& table, std::vector<BondSite>& sites) {
  const CollisionMesh& mesh = system.surface().mesh;
  for (const OverlapSite& s : system.potential().overlap_sites([&](int a, int b) { return table.bonds(a, b); }))
    sites.push_back({s.triangle, s.inside, mesh.triangles[s.triangle][0], -1, s.object, s.area, s.whole});
}

// Returns the triangle at all these vertices that faces the normal most; -1: none.
int triangle_at(const SurfaceTopology& topology, const LaggedSurface& lagged, const CollisionMesh& mesh, std::span<const int> vertices, const Vec3& normal) {
  int found = -1;
  double most = 0;
  for (const int t : topology.triangles_at(vertices[0])) {
    const Triangle& corners = mesh.triangles[t];
    const bool all = std::all_of(vertices.begin(), vertices.end(), [&](int v) { return std::find(corners.begin(), corners.end(), v) != corners.end(); });
    const double facing = topology.two_sided(t) ? std::abs(lagged.normal(t).dot(normal)) : lagged.normal(t).dot(normal);
    if (all && facing > most) most = facing, found = t;
  }
  return found;
}

void add_vertices(const ContactSystem& system, const BondTable& table, const VecX& x, std::vector<BondSite>& sites) {
  const LaggedSurface& lagged = system.lagged_surface();
  const PairTable& pairs = system.pairs();
  std::vector<char> wanted(pairs.laws().size(), 0);
  for (const auto& [a, b] : pairs.classes().examples())
    for (int part = -1; part < pairs.region_pair_count(a, b); ++part)
      if (table.between(a, b, part) >= 0) wanted[pairs.codimensional(a, b, part).law] = 1;
  const ContactPoints points = contact_points({system, wanted, x});
  for_each_record(points, [&](const auto& point) {
    if (point.kind() != PointKind::vertex || !(point.area > 0) || !table.bonds(point.object, point.opposite)) return;
    if (point.object != point.opposite && !lagged.topology().is_codimensional(point.point)) return;
    const std::span<const int> faced(point.vertices.begin() + 1, point.vertices.end());
    const int opposite = triangle_at(lagged.topology(), lagged, system.surface().mesh, faced, point.normal);
    if (opposite >= 0) sites.push_back({-1, Vec3::UnitX(), point.point, opposite, point.opposite, point.area, false});
  });
}

}  // namespace

std::vector<BondSite> bond_sites(const ContactSystem& system, const BondTable& table, const VecX& x) {
  std::vector<BondSite> sites;
  add_triangles(system, table, sites);
  add_vertices(system, table, x, sites);
  return sites;
}

std::optional<Bond> make_bond(const BondSite& site, const ContactSystem& system, const BondTable& table, const VecX& x) {
  const CollisionMesh& mesh = system.surface().mesh;
  Bond bond;
  bond.triangle = site.triangle;
  bond.site_count = site.triangle < 0 ? 1 : 3;
  bond.a = mesh.vertex_object[site.vertex];
  bond.b = site.object;
  const double offset = system.pairs().offset(bond.a, bond.b);
  const Vec3 p = site.triangle < 0 ? Vec3(vertex(x, site.vertex)) : point_inside(x, mesh.triangles[site.triangle], site.inside);

  std::vector<int> near;
  if (site.opposite_triangle >= 0) near.push_back(site.opposite_triangle);
  else system.triangles_near(mesh.triangles[site.triangle], site.inside, near);
  double closest = std::numeric_limits<double>::infinity();
  for (const int t : near) {
    if (mesh.vertex_object[mesh.triangles[t][0]] != bond.b) continue;
    const auto [t0, t1, t2] = corners(x, mesh.triangles[t]);
    const double squared = point_triangle_distance(p, t0, t1, t2);
    if (squared < closest || (squared == closest && t < bond.opposite_triangle)) closest = squared, bond.opposite_triangle = t;
  }
  if (std::isinf(closest)) return std::nullopt;
  bond.vertices[0] = site.vertex;
  bond.rule = rule_of(bond, table, system.pairs(), mesh);
  if (bond.rule < 0) return std::nullopt;
  const BondRule& rule = table.rules()[bond.rule];
  if (!(std::sqrt(closest) <= offset + rule.distance * (1 + rounding))) return std::nullopt;

  const Triangle& opposite = mesh.triangles[bond.opposite_triangle];
  const auto [t0, t1, t2] = corners(x, opposite);
  Vec3 n = (t1 - t0).cross(t2 - t0).normalized();
  if (n.dot(p - t0) < 0) n = -n, bond.side[1] = -1;
  const double height = n.dot(p - t0);
  bond.rest = rule.from_touching ? offset : height;
  // The point of the interface, straight before the place.
  Vec3 interface = p;
  if (bond.site_count == 3) {
    const auto [p0, p1, p2] = corners(x, mesh.triangles[site.triangle]);
    Vec3 own = (p1 - p0).cross(p2 - p0).normalized();
    if (own.dot(n) < 0) own = -own, bond.side[0] = -1;
    bond.lever[0] = table.offset(bond.a) + (rule.from_touching ? 0 : std::max(height - offset, 0.0) / 2);
    interface -= bond.lever[0] * own;
  }
  bond.lever[1] = rule.from_touching ? offset - bond.lever[0] : n.dot(interface - t0);
  const PlaneProjection at = project_onto_triangle(interface, t0, t1, t2);
  for (int i = 0; i < bond.site_count; ++i) {
    bond.vertices[i] = bond.site_count == 1 ? site.vertex : mesh.triangles[site.triangle][i];
    bond.c[i] = site.inside[i];
  }
  std::copy(opposite.begin(), opposite.end(), bond.vertices.begin() + bond.site_count);
  const Vec3 closest_point(1 - at.u - at.v, at.u, at.v);
  for (int i = 0; i < 3; ++i) bond.c[bond.site_count + i] = -closest_point[i];
  bond.area = site.area;
  return bond;
}

}  // namespace tack
