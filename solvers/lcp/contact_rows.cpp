#include "solvers/lcp/contact_rows.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <span>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Neighbours in one body: pairs whose rest distance is below this multiple of the present distance.
// The side of a point against its neighbours only shows how the sheet is bent.
constexpr double of_neighbours = 2;

std::span<const StoredPoint> stored_of(const std::vector<StoredPoint>& stored, int point, int object) {
  const auto before = [](const StoredPoint& h, const std::pair<int, int>& key) { return std::pair(h.point, h.object) < key; };
  const auto after = [](const std::pair<int, int>& key, const StoredPoint& h) { return key < std::pair(h.point, h.object); };
  const std::pair<int, int> key(point, object);
  const auto first = std::lower_bound(stored.begin(), stored.end(), key, before);
  const auto last = std::upper_bound(first, stored.end(), key, after);
  return {stored.data() + (first - stored.begin()), static_cast<size_t>(last - first)};
}

}  // namespace

double friction_between(const ContactSystem& system, int a, int b) {
  const PairRole& role = system.pairs().point(a, b);
  const int law = role.law >= 0 ? role.law : role.safety_barrier;
  return law >= 0 ? system.pairs().tangential(law).mu : 0;
}

ContactFinder::ContactFinder(const ContactSystem& system, double margin)
    : system_(system), surface_(system.surface()), features_(system.surface()), margin_(margin),
      broad_phase_(surface_.mesh, system.colliding()) {}

bool ContactFinder::share_vertex(int triangle, int other) const {
  const Triangle &s = surface_.mesh.triangles[triangle], &t = surface_.mesh.triangles[other];
  return std::find_first_of(s.begin(), s.end(), t.begin(), t.end()) != s.end();
}

// Returns an upper bound of the present distance of stored contacts [m].
double ContactFinder::displaced_depth(const StoredContacts& before, const VecX& displacement) const {
  const CollisionMesh& mesh = surface_.mesh;
  double most = 0;
  for (const StoredPoint& h : before.points) most = std::max(most, h.depth + relative_displacement(displacement, std::array{h.point}, mesh.triangles[h.triangle]));
  for (const StoredEdges& h : before.edges) most = std::max(most, h.depth + relative_displacement(displacement, mesh.edges[h.a], mesh.edges[h.b]));
  return most;
}

void ContactFinder::add_points(const Candidates& candidates, int first, int last, const VecX& x, const VecX& displacement, double search_radius, const StoredContacts& before,
                               Chunk& out) const {
  const CollisionMesh& mesh = surface_.mesh;
  const int p = candidates.point_triangle[first][0], any = candidates.point_triangle[first][1];
  const int own = mesh.vertex_object[p], object = mesh.vertex_object[mesh.triangles[any][0]];
  std::vector<NearPoint> near;
  features_.near_point(candidates, first, last, x, search_radius, near);
  if (near.empty()) return;
  const double offset = system_.pairs().offset(own, object);
  const auto known = stored_of(before.points, p, object);
  // Returns the entry of the triangle, or of a triangle beside it. behind: the point has crossed,
  // and triangles beside share its side.
  const auto entry_of = [&](int triangle, bool behind) -> const StoredPoint* {
    const StoredPoint* found = nullptr;
    for (const StoredPoint& h : known) {
      if (h.triangle == triangle) return &h;
      if (!found && (!behind || h.depth > 0) && share_vertex(h.triangle, triangle)) found = &h;
    }
    return found;
  };
  const auto add = [&](const NearPoint& n, double side, bool behind, const StoredPoint* stored) {
    const double displaced_depth = stored ? stored->depth + relative_displacement(displacement, std::array{p}, mesh.triangles[stored->triangle]) : 0;
    if (n.distance > search_radius_in_margins * margin_ + offset + displaced_depth) return;
    if (own == object && close_at_rest(surface_, std::array{p}, mesh.triangles[n.triangle], std::max(margin_ + offset, of_neighbours * n.distance))) return;
    const double distance = (behind ? -n.distance : n.distance) - offset;
    const double kept = stored ? stored->gap : before.begun ? margin_ : distance;
    const double gap = std::min(margin_, std::max(kept, distance));
    out.points.push_back({p, object, n.triangle, side, gap, std::max(0.0, -distance), stored ? stored->force : Vec3::Zero()});
    ContactRow& row = out.rows.emplace_back();
    row.vertices = {p, p, p, p};
    row.coefficients = {1, 0, 0, 0};
    for (int k = 0; k < n.count; ++k) row.vertices[k + 1] = n.corners[k], row.coefficients[k + 1] = -n.weights[k];
    row.own = 1;
    row.normal = behind ? Vec3(-n.normal) : n.normal;
    row.distance = distance;
    row.gap = gap;
    row.mu = friction_between(system_, own, object);
    row.object = own;
    row.opposite = object;
    row.force = out.points.back().force;
    row.stored = static_cast<int>(out.points.size()) - 1;
  };
  const NearPoint* nearest = nullptr;
  for (const NearPoint& n : near)
    if (!nearest || n.distance < nearest->distance) nearest = &n;
  // Inside a closed body there is one way out: the side where the point came in, or the nearest
  // one.
  const NearPoint* exit_feature = nullptr;
  const StoredPoint* came_in = nullptr;
  if (!features_.two_sided(nearest->triangle) && nearest->facing < 0) {
    for (const NearPoint& n : near) {
      if (n.facing >= 0) continue;
      for (const StoredPoint& h : known)
        if (h.side > 0 && share_vertex(h.triangle, n.triangle) && n.normal.dot(features_.normal_of(h.triangle, x)) < -0.5 &&
            (!came_in || n.distance < exit_feature->distance))
          exit_feature = &n, came_in = &h;
    }
    if (!exit_feature && own != object) exit_feature = nearest;
  }
  for (const NearPoint& n : near) {
    const StoredPoint* stored = entry_of(n.triangle, false);
    if (!features_.two_sided(n.triangle)) {
      if (n.facing >= 0) add(n, 1, false, stored);
      else if (&n == exit_feature) add(n, 1, true, came_in ? came_in : stored);
      continue;
    }
    const double there = std::abs(n.facing) < beside ? 0 : n.facing > 0 ? 1 : -1;
    const StoredPoint* of_side = entry_of(n.triangle, true);
    const double side = there != 0 && of_side && of_side->side != 0 ? of_side->side : there;
    add(n, side, side != there, stored);
  }
}

// Returns the side of two edges from the stored entry, or from end points that have crossed: -1 if
// they have.
double ContactFinder::side_of_edges(const NearEdges& near, const VecX& x, const std::vector<StoredPoint>& sides, const StoredEdges* stored) const {
  const CollisionMesh& mesh = surface_.mesh;
  const auto by_ends = [&](const Edge& ends, const Edge& other, const Vec3& towards) {
    const int object = mesh.vertex_object[other[0]];
    double found = 0;
    for (const int p : ends)
      for (const StoredPoint& h : stored_of(sides, p, object)) {
        const Triangle& t = mesh.triangles[h.triangle];
        if (found != 0 || h.side == 0 || !(h.depth > 0) || !features_.two_sided(h.triangle) || std::find_first_of(t.begin(), t.end(), other.begin(), other.end()) == t.end()) continue;
        const double cosine = h.side * features_.normal_of(h.triangle, x).dot(towards);
        if (std::abs(cosine) > beside) found = cosine > 0 ? 1 : -1;
      }
    return found;
  };
  if (stored) return stored->normal.dot(near.normal) < 0 ? -1 : 1;
  const Edge &a = mesh.edges[near.a], &b = mesh.edges[near.b];
  if (const double side = by_ends(a, b, near.normal); side != 0) return side;
  if (const double side = by_ends(b, a, -near.normal); side != 0) return side;
  return 1;
}

void ContactFinder::add_edges(int a, int b, const VecX& x, const VecX& displacement, const StoredContacts& before, const std::vector<StoredPoint>& sides, Chunk& out) const {
  const CollisionMesh& mesh = surface_.mesh;
  const Edge &ea = mesh.edges[a], &eb = mesh.edges[b];
  const int object = mesh.vertex_object[ea[0]], opposite = mesh.vertex_object[eb[0]];
  const double offset = system_.pairs().offset(object, opposite), margin = edge_gap_fraction * margin_;
  const auto at = std::lower_bound(before.edges.begin(), before.edges.end(), std::pair(a, b),
                                   [](const StoredEdges& h, const std::pair<int, int>& key) { return std::pair(h.a, h.b) < key; });
  const StoredEdges* stored = at != before.edges.end() && at->a == a && at->b == b ? &*at : nullptr;
  const double search_radius = search_radius_in_margins * margin + offset + (stored ? stored->depth + relative_displacement(displacement, ea, eb) : 0);
  const auto [a0, a1] = corners(x, ea);
  const auto [b0, b1] = corners(x, eb);
  if ((a0 + a1 - b0 - b1).norm() > 2 * search_radius + (a1 - a0).norm() + (b1 - b0).norm()) return;
  NearEdges near;
  if (!features_.near_edges(a, b, x, near) || near.distance > search_radius) return;
  if (object == opposite && close_at_rest(surface_, ea, eb, std::max(margin + offset, of_neighbours * near.distance))) return;
  const bool a_faces = features_.two_sided_at(a) || near.facing_a > 0, b_faces = features_.two_sided_at(b) || near.facing_b > 0;
  bool crossed = false;
  if (a_faces && b_faces) crossed = side_of_edges(near, x, sides, stored) < 0;
  else if (!a_faces && !b_faces && stored) crossed = true;
  else if (!stored || stored->normal.dot(near.normal) > 0) return;
  else crossed = true;
  const double distance = (crossed ? -near.distance : near.distance) - offset;
  const Vec3 normal = crossed ? Vec3(-near.normal) : near.normal;
  const double kept = stored ? stored->gap : before.begun ? margin : distance;
  const double gap = std::min(margin, std::max(kept, distance));
  out.edges.push_back({a, b, normal, gap, std::max(0.0, -distance), stored ? stored->force : Vec3::Zero()});
  ContactRow& row = out.rows.emplace_back();
  row.vertices = {ea[0], ea[1], eb[0], eb[1]};
  row.coefficients = {1 - near.at[0], near.at[0], near.at[1] - 1, -near.at[1]};
  row.own = 2;
  row.normal = normal;
  row.distance = distance;
  row.gap = gap;
  row.mu = friction_between(system_, object, opposite);
  row.object = object;
  row.opposite = opposite;
  row.force = stored ? stored->force : Vec3::Zero();
  row.stored = static_cast<int>(out.edges.size()) - 1;
}

ContactRows ContactFinder::find(const VecX& x, const VecX& displacement, const StoredContacts& before) {
  const double search_radius = search_radius_in_margins * margin_ + system_.pairs().largest_offset() + displaced_depth(before, displacement);
  broad_phase_.update(x, VecX(), search_radius, 0.5 * margin_);
  const Candidates& candidates = broad_phase_.candidates();

  ContactRows found;
  found.stored.begun = true;
  const auto join = [&](std::vector<Chunk>& chunks) {
    for (Chunk& chunk : chunks) {
      for (ContactRow& row : chunk.rows) {
        if (row.stored >= 0) row.stored += static_cast<int>(row.own == 1 ? found.stored.points.size() : found.stored.edges.size());
        found.rows.push_back(row);
      }
      std::move(chunk.points.begin(), chunk.points.end(), std::back_inserter(found.stored.points));
      std::move(chunk.edges.begin(), chunk.edges.end(), std::back_inserter(found.stored.edges));
    }
  };
  std::vector<PointGroup> groups;
  std::copy_if(candidates.groups.all.begin(), candidates.groups.all.end(), std::back_inserter(groups), [](const PointGroup& g) { return g.has_triangles(); });
  const int n = static_cast<int>(groups.size());
  std::vector<Chunk> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i) add_points(candidates, groups[i].triangle_begin, groups[i].triangle_end, x, displacement, search_radius, before, chunks[c]);
  });
  join(chunks);
  const int edges = static_cast<int>(candidates.edge_edge.size());
  chunks.assign(chunk_count(edges), {});
  const std::vector<StoredPoint> sides = found.stored.points;
  for_each_chunk(edges, [&](int c, int first, int last) {
    for (int i = first; i < last; ++i) add_edges(candidates.edge_edge[i][0], candidates.edge_edge[i][1], x, displacement, before, sides, chunks[c]);
  });
  join(chunks);
  return found;
}

}  // namespace tack
