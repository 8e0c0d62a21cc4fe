#include "solvers/lcp/impact_rows.hpp"

#include <Eigen/Geometry>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/ccd/accd.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Fraction of the initial gap that is left at the configuration of the normals.
constexpr double of_gap = 0.05;

}  // namespace

ImpactFinder::ImpactFinder(const ContactSystem& system, double margin)
    : system_(system), surface_(system.surface()), margin_(margin), broad_phase_(surface_.mesh, system.colliding()) {}

void ImpactFinder::finish(ContactRow& row, int object, int opposite, const VecX& x, double margin) const {
  row.distance = row.normal.dot(row.moved(x)) - system_.pairs().offset(object, opposite);
  row.gap = margin;
  row.mu = friction_between(system_, object, opposite);
  row.object = object;
  row.opposite = opposite;
  row.force.setZero();
}

bool ImpactFinder::meets(int point, int triangle, const VecX& x, const VecX& displacement, Impact& out) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Triangle& t = mesh.triangles[triangle];
  const std::array<int, 1> p{point};
  const int object = mesh.vertex_object[point], opposite = mesh.vertex_object[t[0]];
  const double offset = system_.pairs().offset(object, opposite);
  const auto [a, b, c] = corners(x, t);
  const auto [da, db, dc] = corners(displacement, t);
  const Vec3 q = vertex(x, point), dq = vertex(displacement, point);
  const double distance = std::sqrt(squared_distance(corners(x, p), corners(x, t)));
  if (distance <= offset || distance - offset > relative_displacement(displacement, p, t)) return false;
  if (object == opposite && close_at_rest(surface_, p, t, margin_ + offset)) return false;
  const double when = point_triangle_accd(q, a, b, c, dq, da, db, dc, of_gap, 1, offset);
  if (when >= 1) return false;
  const Vec3 at_a = a + when * da, at_b = b + when * db, at_c = c + when * dc, at_q = q + when * dq;
  const Vec3 l = point_triangle_barycentric(at_q, at_a, at_b, at_c), r = at_q - l[0] * at_a - l[1] * at_b - l[2] * at_c;
  if (!(r.norm() > 0)) return false;
  out = {};
  out.of_edges = false;
  out.who = {point, triangle};
  out.row.vertices = {point, t[0], t[1], t[2]};
  out.row.coefficients = {1, -l[0], -l[1], -l[2]};
  out.row.own = 1;
  out.row.normal = r.normalized();
  if (surface_.two_sided[triangle]) {
    const double facing = (at_b - at_a).cross(at_c - at_a).normalized().dot(out.row.normal);
    out.side = std::abs(facing) < beside ? 0 : facing > 0 ? 1 : -1;
  } else {
    out.side = 1;
  }
  finish(out.row, object, opposite, x, margin_);
  return true;
}

bool ImpactFinder::edges_meet(int a, int b, const VecX& x, const VecX& displacement, Impact& out) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Edge &ea = mesh.edges[a], &eb = mesh.edges[b];
  const int object = mesh.vertex_object[ea[0]], opposite = mesh.vertex_object[eb[0]];
  const double offset = system_.pairs().offset(object, opposite), margin = edge_gap_fraction * margin_;
  const auto [a0, a1] = corners(x, ea);
  const auto [b0, b1] = corners(x, eb);
  const auto [da0, da1] = corners(displacement, ea);
  const auto [db0, db1] = corners(displacement, eb);
  const double distance = std::sqrt(squared_distance(corners(x, ea), corners(x, eb)));
  if (distance <= offset || distance - offset > relative_displacement(displacement, ea, eb)) return false;
  if (object == opposite && close_at_rest(surface_, ea, eb, margin_ + offset)) return false;
  const double when = edge_edge_accd(a0, a1, b0, b1, da0, da1, db0, db1, of_gap, 1, offset);
  if (when >= 1) return false;
  const Vec3 p0 = a0 + when * da0, p1 = a1 + when * da1, q0 = b0 + when * db0, q1 = b1 + when * db1;
  // Rows of points cover this pair.
  if (edge_edge_type(p0, p1, q0, q1) != EdgeEdgeType::EA_EB) return false;
  const Vec2 at = edge_edge_parameters(p0, p1, q0, q1, EdgeEdgeType::EA_EB);
  const Vec3 r = (1 - at[0]) * p0 + at[0] * p1 - (1 - at[1]) * q0 - at[1] * q1;
  if (!(r.norm() > 0)) return false;
  out = {};
  out.of_edges = true;
  out.who = {a, b};
  out.row.vertices = {ea[0], ea[1], eb[0], eb[1]};
  out.row.coefficients = {1 - at[0], at[0], at[1] - 1, -at[1]};
  out.row.own = 2;
  out.row.normal = r.normalized();
  finish(out.row, object, opposite, x, margin);
  return true;
}

void ImpactFinder::begin(const StoredContacts& near) {
  found_points_.clear();
  found_edges_.clear();
  for (const StoredPoint& h : near.points) found_points_.insert({h.point, h.triangle});
  for (const StoredEdges& h : near.edges) found_edges_.insert({h.a, h.b});
}

void ImpactFinder::find(const VecX& x, const VecX& end, ContactRows& out) {
  const VecX displacement = end - x;
  broad_phase_.update(x, displacement, system_.pairs().largest_offset(), 0);
  const Candidates& candidates = broad_phase_.candidates();
  const int points = static_cast<int>(candidates.point_triangle.size()), all = points + static_cast<int>(candidates.edge_edge.size());
  std::vector<std::vector<Impact>> chunks(chunk_count(all));
  for_each_chunk(all, [&](int chunk, int first, int last) {
    Impact impact;
    for (int i = first; i < last; ++i) {
      const auto& [a, b] = i < points ? candidates.point_triangle[i] : candidates.edge_edge[i - points];
      if ((i < points ? found_points_ : found_edges_).contains({a, b})) continue;
      if (i < points ? meets(a, b, x, displacement, impact) : edges_meet(a, b, x, displacement, impact)) chunks[chunk].push_back(impact);
    }
  });
  StoredContacts& stored = out.stored;
  for (const auto& chunk : chunks)
    for (const Impact& impact : chunk) {
      (impact.of_edges ? found_edges_ : found_points_).insert(impact.who);
      const auto& [a, b] = impact.who;
      ContactRow& row = out.rows.emplace_back(impact.row);
      row.stored = static_cast<int>(impact.of_edges ? stored.edges.size() : stored.points.size());
      if (impact.of_edges) stored.edges.push_back({a, b, row.normal, row.gap, 0, row.force});
      else stored.points.push_back({a, row.opposite, b, impact.side, row.gap, 0, row.force});
    }
}

}  // namespace tack
