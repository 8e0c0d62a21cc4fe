#include "framework/bond/bond_sites.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <limits>
#include <set>

#include "framework/contact/coverage.hpp"
#include "framework/contact/held_surface.hpp"
#include "geometry/distance/closest_feature.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

constexpr double rounding = 1e-9;  // of the distance: surfaces may be placed just so far apart

}  // namespace

std::vector<BondSite> bond_sites(const ContactSystem& system, const BondTable& table) {
  std::vector<BondSite> sites;
  const std::vector<int>& object = system.surface().mesh.vertex_object;
  for (const CoveredParts& pair : system.coverage().parts()) {
    if (table.between(pair.a, pair.b) < 0) continue;
    const double share = system.pairs().point(pair.a, pair.b).share;
    for (const CoveredTriangle& t : pair.whole)
      for (int i = 0; i < 3; ++i) {
        Vec3 inside = Vec3::Constant(1.0 / 6);
        inside[i] = 2.0 / 3;
        sites.push_back({t.triangle, inside, pair.b, share * t.area / 3, true});
      }
  }
  for (const ContactSample& s : system.coverage().samples()) {
    const int a = object[system.surface().mesh.triangles[s.triangle][0]];
    if (table.between(a, s.object) < 0) continue;
    sites.push_back({s.triangle, s.inside, s.object, system.pairs().point(a, s.object).share * s.area, false});
  }
  return sites;
}

std::optional<Bond> make_bond(const BondSite& site, const ContactSystem& system, const BondTable& table, const VecX& x) {
  const CollisionMesh& mesh = system.surface().mesh;
  const Triangle& own = mesh.triangles[site.triangle];
  Bond bond;
  bond.triangle = site.triangle;
  bond.a = mesh.vertex_object[own[0]];
  bond.b = site.object;
  bond.rule = table.between(bond.a, bond.b);
  const BondRule& rule = table.rules()[bond.rule];
  const double offset = system.pairs().offset(bond.a, bond.b);
  const Vec3 p = point_inside(x, own, site.inside);

  std::vector<int> near;
  system.triangles_near(own, site.inside, near);
  double closest = std::numeric_limits<double>::infinity();
  for (const int t : near) {
    if (mesh.vertex_object[mesh.triangles[t][0]] != bond.b) continue;
    const auto [t0, t1, t2] = corners(x, mesh.triangles[t]);
    const double squared = point_triangle_distance(p, t0, t1, t2);
    if (squared < closest || (squared == closest && t < bond.anchor)) closest = squared, bond.anchor = t;
  }
  if (!(std::sqrt(closest) <= offset + rule.distance * (1 + rounding))) return std::nullopt;

  const Triangle& anchor = mesh.triangles[bond.anchor];
  const auto [t0, t1, t2] = corners(x, anchor);
  const PlaneProjection at = project_onto_triangle(p, t0, t1, t2);
  const Vec3 n = (t1 - t0).cross(t2 - t0).normalized();
  bond.side = n.dot(p - t0) < 0 ? -1 : 1;
  bond.normal = bond.side * n;
  std::copy(own.begin(), own.end(), bond.vertices.begin());
  std::copy(anchor.begin(), anchor.end(), bond.vertices.begin() + 3);
  bond.c = {site.inside[0], site.inside[1], site.inside[2], at.u + at.v - 1, -at.u, -at.v};
  bond.area = site.area;
  bond.rest = rule.from_touching ? offset : std::abs(n.dot(p - t0));
  return bond;
}

}  // namespace tack
