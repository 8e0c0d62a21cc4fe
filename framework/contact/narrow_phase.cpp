#include "framework/contact/narrow_phase.hpp"

#include <algorithm>
#include <limits>

#include "framework/assembly/parallel.hpp"
#include "framework/contact/point_features.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/distance/point_edge.hpp"
#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

// Particle candidates in both directions, (point, other), sorted.
std::vector<std::array<int, 2>> particle_pairs(const Candidates& candidates) {
  auto pairs = candidates.point_point;
  for (const auto& [a, b] : candidates.point_point) pairs.push_back({b, a});
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

template <class ObjectOf>
void add_runs(const std::vector<std::array<int, 2>>& pairs, const ObjectOf& object_of,
              int PointGroup::* begin, int PointGroup::* end, std::vector<PointGroup>& groups) {
  for (int i = 0; i < static_cast<int>(pairs.size());) {
    PointGroup group{pairs[i][0], object_of(pairs[i][1])};
    group.*begin = i;
    while (i < static_cast<int>(pairs.size()) && pairs[i][0] == group.point &&
           object_of(pairs[i][1]) == group.object)
      ++i;
    group.*end = i;
    groups.push_back(group);
  }
}

// Unites the groups of the same point and object.
std::vector<PointGroup> united(std::vector<PointGroup> groups) {
  const auto key = [](const PointGroup& g) { return std::array{g.point, g.object}; };
  std::stable_sort(groups.begin(), groups.end(),
                   [&](const PointGroup& a, const PointGroup& b) { return key(a) < key(b); });
  size_t kept = 0;
  for (const PointGroup& g : groups) {
    if (kept > 0 && key(groups[kept - 1]) == key(g)) {
      PointGroup& u = groups[kept - 1];
      if (g.edge_end > g.edge_begin) u.edge_begin = g.edge_begin, u.edge_end = g.edge_end;
      if (g.other_end > g.other_begin) u.other_begin = g.other_begin, u.other_end = g.other_end;
    } else {
      groups[kept++] = g;
    }
  }
  groups.resize(kept);
  return groups;
}

template <size_t K>
bool none_free(const std::vector<char>& free, const std::array<int, K>& vertices) {
  const auto is_free = [&](int v) { return free[v] != 0; };
  return !free.empty() && std::none_of(vertices.begin(), vertices.end(), is_free);
}

// What one chunk finds; chunks are joined in order.
struct Found {
  ContactStencils<2> point_point;
  ContactStencils<3> point_edge;
  ContactStencils<4> point_triangle;
  ContactStencils<4> edge_edge;
};

class PointSearch {
 public:
  PointSearch(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates,
              const std::vector<std::array<int, 2>>& particles, const std::vector<char>& free,
              const VecX& x, Found& found)
      : surface_(surface), pairs_(pairs), candidates_(candidates), particles_(particles), free_(free),
        x_(x), found_(found) {}

  void search(const PointGroup& g) {
    const PairRole& role = pairs_.point(surface_.mesh.vertex_object[g.point], g.object);
    if (role.law < 0) return;
    triangles_.clear();
    edges_.clear();
    others_.clear();
    for (int i = g.triangle_begin; i < g.triangle_end; ++i)
      triangles_.push_back(surface_.mesh.triangles[candidates_.point_triangle[i][1]]);
    for (int i = g.edge_begin; i < g.edge_end; ++i)
      edges_.push_back(surface_.mesh.edges[candidates_.point_edge[i][1]]);
    for (int i = g.other_begin; i < g.other_end; ++i) others_.push_back(particles_[i][1]);
    for (const PointFeature& f : features_.reduce(x_, g.point, triangles_, edges_, others_, role.range,
                                                  pairs_.plain_sums))
      add(g.point, f, role.law, g.area * f.multiplicity);
  }

 private:
  void add(int p, const PointFeature& f, int law, double weight) {
    const auto& v = f.vertices;
    switch (f.count()) {
      case 1: keep(found_.point_point, {{p, v[0]}, law, weight}); break;
      case 2: keep(found_.point_edge, {{p, v[0], v[1]}, law, weight}); break;
      default: keep(found_.point_triangle, {{p, v[0], v[1], v[2]}, law, weight});
    }
  }
  template <int K>
  void keep(ContactStencils<K>& stencils, const std::type_identity_t<ContactStencil<K>>& stencil) {
    if (!none_free(free_, stencil.vertices)) stencils.push_back(stencil);
  }

  const ContactSurface& surface_;
  const PairTable& pairs_;
  const Candidates& candidates_;
  const std::vector<std::array<int, 2>>& particles_;
  const std::vector<char>& free_;
  const VecX& x_;
  Found& found_;
  PointFeatures features_;
  std::vector<Triangle> triangles_;
  std::vector<Edge> edges_;
  std::vector<int> others_;
};

void search_edges(const ContactSurface& surface, const PairTable& pairs,
                  const Candidates& candidates, const std::vector<char>& free, const VecX& x, int first,
                  int last, Found& found) {
  const CollisionMesh& mesh = surface.mesh;
  for (int i = first; i < last; ++i) {
    const auto [ia, ib] = candidates.edge_edge[i];
    const Edge &a = mesh.edges[ia], &b = mesh.edges[ib];
    const PairRole& role = pairs.edge(mesh.vertex_object[a[0]], mesh.vertex_object[b[0]]);
    if (role.law < 0) continue;
    const Vec3 a0 = vertex(x, a[0]), a1 = vertex(x, a[1]), b0 = vertex(x, b[0]), b1 = vertex(x, b[1]);
    const Vec3 gap = (a0.cwiseMin(a1) - b0.cwiseMax(b1)).cwiseMax(b0.cwiseMin(b1) - a0.cwiseMax(a1));
    if (gap.maxCoeff() >= role.range) continue;  // their boxes are too far apart already
    if (!(edge_edge_distance(a0, a1, b0, b1) < role.range * role.range)) continue;
    if (none_free(free, std::array{a[0], a[1], b[0], b[1]})) continue;
    const double weight = role.share * (surface.edge_area[ia] + surface.edge_area[ib]);
    found.edge_edge.push_back({{a[0], a[1], b[0], b[1]}, role.law, weight});
  }
}

template <int K>
void join(const std::vector<Found>& chunks, ContactStencils<K> Found::* member,
          ContactStencils<K>& all) {
  all.clear();
  for (const Found& chunk : chunks)
    all.insert(all.end(), (chunk.*member).begin(), (chunk.*member).end());
  const auto by_law = [](const auto& a, const auto& b) { return a.law < b.law; };
  if (!std::is_sorted(all.begin(), all.end(), by_law)) std::stable_sort(all.begin(), all.end(), by_law);
}

}  // namespace

NarrowPhase::NarrowPhase(const ContactSurface& surface, const PairTable& pairs)
    : surface_(surface), pairs_(pairs),
      facing_(surface.mesh, surface.closed, surface.vertex_area, surface.rest) {}

void NarrowPhase::make_groups(const Candidates& candidates) {
  const CollisionMesh& mesh = surface_.mesh;
  particles_ = particle_pairs(candidates);
  groups_.clear();
  add_runs(candidates.point_triangle, [&](int t) { return mesh.vertex_object[mesh.triangles[t][0]]; },
           &PointGroup::triangle_begin, &PointGroup::triangle_end, groups_);
  if (candidates.point_edge.empty() && particles_.empty()) return;
  add_runs(candidates.point_edge, [&](int e) { return mesh.vertex_object[mesh.edges[e][0]]; },
           &PointGroup::edge_begin, &PointGroup::edge_end, groups_);
  add_runs(particles_, [&](int v) { return mesh.vertex_object[v]; }, &PointGroup::other_begin,
           &PointGroup::other_end, groups_);
  groups_ = united(std::move(groups_));
}

// The area that the point turns to the nearest of its candidates.
double NarrowPhase::area_of(const PointGroup& g, const Candidates& candidates, const VecX& x) const {
  const CollisionMesh& mesh = surface_.mesh;
  const PairRole& role = pairs_.point(mesh.vertex_object[g.point], g.object);
  if (role.law < 0 || !role.facing) return role.share * facing_.whole(g.point);
  const Vec3 p = vertex(x, g.point);
  Vec3 shortest = Vec3::Zero();
  double nearest = std::numeric_limits<double>::infinity();
  const auto consider = [&](const Vec3& separation) {
    if (!(separation.squaredNorm() < nearest)) return;
    nearest = separation.squaredNorm();
    shortest = separation;
  };
  for (int i = g.triangle_begin; i < g.triangle_end; ++i) {
    const Triangle& t = mesh.triangles[candidates.point_triangle[i][1]];
    consider(point_triangle_separation(p, vertex(x, t[0]), vertex(x, t[1]), vertex(x, t[2])));
  }
  for (int i = g.edge_begin; i < g.edge_end; ++i) {
    const Edge& e = mesh.edges[candidates.point_edge[i][1]];
    const double u = point_edge_closest(p, vertex(x, e[0]), vertex(x, e[1])).parameter;
    consider(p - (1 - u) * vertex(x, e[0]) - u * vertex(x, e[1]));
  }
  for (int i = g.other_begin; i < g.other_end; ++i) consider(p - vertex(x, particles_[i][1]));
  return role.share * facing_(x, g.point, shortest);
}

// Areas of groups known in this step stay; those of new groups are taken at x.
void NarrowPhase::take_areas(const Candidates& candidates, const VecX& x) {
  const auto by_key = [](const PointGroup& a, const PointGroup& b) { return a.key() < b.key(); };
  for_each(static_cast<int>(groups_.size()), [&](int i) {
    PointGroup& g = groups_[i];
    const auto known = std::lower_bound(known_.begin(), known_.end(), g, by_key);
    const bool found = known != known_.end() && known->key() == g.key();
    g.area = found ? known->area : area_of(g, candidates, x);
  });
  std::vector<PointGroup> all;
  std::set_union(known_.begin(), known_.end(), groups_.begin(), groups_.end(), std::back_inserter(all),
                 by_key);
  known_ = std::move(all);
}

void NarrowPhase::set_candidates(const Candidates& candidates, const VecX& x) {
  make_groups(candidates);
  take_areas(candidates, x);
}

void NarrowPhase::begin_step(const Candidates& candidates, const VecX& x) {
  known_.clear();
  take_areas(candidates, x);
}

void NarrowPhase::find(const Candidates& candidates, const VecX& x, ContactSet& contacts) const {
  const int points = static_cast<int>(groups_.size());
  const int edges = static_cast<int>(candidates.edge_edge.size());
  std::vector<Found> found_points(chunk_count(points)), found_edges(chunk_count(edges));
  for_each_chunk(points, [&](int c, int first, int last) {
    PointSearch search(surface_, pairs_, candidates, particles_, free_, x, found_points[c]);
    for (int g = first; g < last; ++g) search.search(groups_[g]);
  });
  for_each_chunk(edges, [&](int c, int first, int last) {
    search_edges(surface_, pairs_, candidates, free_, x, first, last, found_edges[c]);
  });
  join(found_points, &Found::point_point, contacts.point_point);
  join(found_points, &Found::point_edge, contacts.point_edge);
  join(found_points, &Found::point_triangle, contacts.point_triangle);
  join(found_edges, &Found::edge_edge, contacts.edge_edge);
  contacts.mollifier_threshold.clear();
  for (const auto& s : contacts.edge_edge)
    contacts.mollifier_threshold.push_back(edge_edge_mollifier_threshold(
        vertex(surface_.rest, s.vertices[0]), vertex(surface_.rest, s.vertices[1]),
        vertex(surface_.rest, s.vertices[2]), vertex(surface_.rest, s.vertices[3])));
}

}  // namespace tack
