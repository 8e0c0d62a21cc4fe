#include "framework/contact/area_integral/narrow_phase.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "framework/contact/area_integral/sorted_cursor.hpp"
#include "framework/contact/point_features.hpp"
#include "framework/contact/rest_neighbours.hpp"
#include "geometry/broad_phase/displacement_bounds.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Returns whether any vertex is marked; an empty list marks all.
bool any_of(const std::vector<char>& marked, std::span<const int> vertices) {
  return marked.empty() || std::any_of(vertices.begin(), vertices.end(), [&](int v) { return marked[v] != 0; });
}

using FoundStencils = ContactSet;  // of one chunk, without thresholds; chunks are joined in order

// Base of the searches for stencils of vertices and of interior points.
class StencilSearch {
 protected:
  StencilSearch(const CollisionMesh& mesh, const PairTable& pairs, const FreeVertices& free, const VecX& x,
                FoundStencils& found)
      : mesh_(mesh), pairs_(pairs), x_(x), found_(found), free_(free) {}

  // Adds a stencil that may move. Own: the number of vertices of the point, before those of the feature.
  template <int Own, class Stencil>
  void add_if_free(std::vector<Stencil>& stencils, const std::type_identity_t<Stencil>& stencil) {
    const std::span<const int> all(stencil.vertices);
    if (any_of(free_.free, all.first(Own)) || any_of(free_.one_ring, all.subspan(Own))) stencils.push_back(stencil);
  }

  const CollisionMesh& mesh_;
  const PairTable& pairs_;
  const VecX& x_;
  FoundStencils& found_;
  PointFeatures features_;
  std::vector<Triangle> triangles_;

 private:
  const FreeVertices& free_;
};

class VertexSearch : StencilSearch {
 public:
  VertexSearch(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates, const DisplacementBounds& displacements,
               const VertexQuadrature& quadrature, const FreeVertices& free, const VecX& x, FoundStencils& found)
      : StencilSearch(surface.mesh, pairs, free, x, found), candidates_(candidates), displacements_(displacements), quadrature_(quadrature) {}

  void search(const VertexQuadraturePoint& point) {
    triangles_.clear();
    weights_.clear();
    for (int i = point.triangle_begin; i < point.triangle_end; ++i) {
      const int candidate = quadrature_.triangles[i], t = candidates_.point_triangle[candidate][1];
      const double displacement = displacements_.vertex(point.point) + displacements_.triangle(t);
      if (!(candidates_.reference_distances.point_triangle[candidate] - displacement < point.range)) continue;
      triangles_.push_back(mesh_.triangles[t]);
      if (point.weight_begin >= 0) weights_.push_back(quadrature_.weights[point.weight_begin + i - point.triangle_begin]);
    }
    if (point.weight_begin >= 0) {
      for (const PointFeature& f : features_.reduce(x_, vertex(x_, point.point), triangles_, weights_, point.range))
        add(point.point, f, point.law, point.area * f.multiplicity);
      return;
    }
    if (triangles_.empty() && point.edge_begin == point.edge_end && point.other_begin == point.other_end) return;
    edges_.clear();
    for (int i = point.edge_begin; i < point.edge_end; ++i) edges_.push_back(mesh_.edges[quadrature_.edges[i]]);
    const std::span<const int> others(quadrature_.others.data() + point.other_begin, quadrature_.others.data() + point.other_end);
    for (const PointFeature& f : features_.reduce(x_, vertex(x_, point.point), triangles_, edges_, others, point.range,
                                                  pairs_.plain_sums))
      add(point.point, f, point.law, point.area * f.multiplicity);
  }

 private:
  void add(int p, const PointFeature& f, int law, double weight) {
    const auto& v = f.vertices;
    switch (f.count()) {
      case 1: add_if_free<1>(found_.point_point, {{p, v[0]}, law, weight}); break;
      case 2: add_if_free<1>(found_.point_edge, {{p, v[0], v[1]}, law, weight}); break;
      default: add_if_free<1>(found_.point_triangle, {{p, v[0], v[1], v[2]}, law, weight});
    }
  }

  const Candidates& candidates_;
  const DisplacementBounds& displacements_;
  const VertexQuadrature& quadrature_;
  std::vector<TriangleWeight> weights_;
  std::vector<Edge> edges_;
};

class InteriorSearch : StencilSearch {
 public:
  InteriorSearch(const ContactSurface& surface, const PairTable& pairs, const std::vector<InteriorPoint>& points,
                 const InteriorPatches& patches, const FreeVertices& free, const VecX& x, FoundStencils& found)
      : StencilSearch(surface.mesh, pairs, free, x, found), points_(points), patches_(patches) {}

  void search(int i) {
    const InteriorPoint& point = points_[i];
    const Triangle& own = mesh_.triangles[point.triangle];
    const PairRole& role = pairs_.point(mesh_.vertex_object[own[0]], point.object, point.region_pair);
    triangles_.clear();
    for (int k = patches_.ranges[i].begin; k < patches_.ranges[i].end; ++k) triangles_.push_back(mesh_.triangles[patches_.triangles[k]]);
    const Vec3 p = point_inside(x_, own, point.inside);
    for (const PointFeature& f : features_.reduce(x_, p, triangles_, {}, {}, role.range, false)) {
      const auto [a, b, c] = own;
      const auto& v = f.vertices;
      const double weight = role.area_factor * point.area * f.multiplicity;
      switch (f.count()) {
        case 1: add_if_free<3>(found_.interior_point, {{a, b, c, v[0]}, role.law, weight, point.inside, i}); break;
        case 2: add_if_free<3>(found_.interior_edge, {{a, b, c, v[0], v[1]}, role.law, weight, point.inside, i}); break;
        default: add_if_free<3>(found_.interior_triangle, {{a, b, c, v[0], v[1], v[2]}, role.law, weight, point.inside, i});
      }
    }
  }

 private:
  const std::vector<InteriorPoint>& points_;
  const InteriorPatches& patches_;
};

const PairRole& edge_role(const CollisionMesh& mesh, const PairTable& pairs, const Edge& a, const Edge& b) {
  const int object = mesh.vertex_object[a[0]], other = mesh.vertex_object[b[0]];
  return pairs.edge(object, other, pairs.region_pair(object, other, a, b));
}

// Returns the area of a pair of edges. An edge without area does not limit the area of the other.
double shared_area(double a, double b, double area_ratio_max) {
  const auto [smaller, larger] = std::minmax(a, b);
  return smaller > 0 ? smaller + std::min(larger, area_ratio_max * smaller) : larger;
}

void search_edges(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates,
                  const std::vector<EdgePair>& edge_pairs, const DisplacementBounds& displacements, const std::vector<char>& free, const VecX& x,
                  int first, int last, FoundStencils& found) {
  const CollisionMesh& mesh = surface.mesh;
  const double largest = pairs.largest_edge_range();
  for (int i = first; i < last; ++i) {
    const auto [ia, ib] = edge_pairs[i].edges;
    if (candidates.reference_distances.edge_edge[edge_pairs[i].candidate] - displacements.edge(ia) - displacements.edge(ib) >= largest) continue;
    const Edge &a = mesh.edges[ia], &b = mesh.edges[ib];
    const PairRole& role = edge_role(mesh, pairs, a, b);
    const int law = edge_pairs[i].law;
    const double range = law == role.law ? role.range : surface.rest_gaps->range(law);
    const auto ca = corners(x, a), cb = corners(x, b);
    if (box_gaps(ca, cb).maxCoeff() >= range) continue;  // their boxes are too far apart already
    if (!(edge_edge_distance(ca[0], ca[1], cb[0], cb[1]) < range * range)) continue;
    if (!any_of(free, std::array{a[0], a[1], b[0], b[1]})) continue;
    const double weight = role.area_factor * shared_area(surface.edge_area[ia], surface.edge_area[ib], role.area_ratio_max);
    found.edge_edge.push_back({{a[0], a[1], b[0], b[1]}, law, weight});
  }
}

// Finds the stencils of crossing rods, weighted with the area of their overlap.
void search_crossings(const ContactSurface& surface, const PairTable& pairs, const std::vector<RodOverlaps::Crossing>& crossings,
                      const std::vector<char>& free, const VecX& x, FoundStencils& found) {
  const CollisionMesh& mesh = surface.mesh;
  for (const auto& [edges, area] : crossings) {
    const Edge &a = mesh.edges[edges[0]], &b = mesh.edges[edges[1]];
    const int object = mesh.vertex_object[a[0]], other = mesh.vertex_object[b[0]];
    const PairRole& role = pairs.codimensional(object, other, pairs.region_pair(object, other, a, b));
    const int law = object == other && surface.rest_gaps ? surface.rest_gaps->law_of_edges(role.law, a, b) : role.law;
    const double range = law == role.law ? role.range : surface.rest_gaps->range(law);
    const auto ca = corners(x, a), cb = corners(x, b);
    if (!(edge_edge_distance(ca[0], ca[1], cb[0], cb[1]) < range * range)) continue;
    if (!any_of(free, std::array{a[0], a[1], b[0], b[1]})) continue;
    found.edge_edge.push_back({{a[0], a[1], b[0], b[1]}, law, area});
  }
}

template <class Stencils>
void join(const std::vector<FoundStencils>& chunks, Stencils FoundStencils::* member, Stencils& all) {
  all.clear();
  for (const FoundStencils& chunk : chunks)
    all.insert(all.end(), (chunk.*member).begin(), (chunk.*member).end());
  const auto by_law = [](const auto& a, const auto& b) { return a.law < b.law; };
  if (!std::is_sorted(all.begin(), all.end(), by_law)) std::stable_sort(all.begin(), all.end(), by_law);
}

}  // namespace

NarrowPhase::NarrowPhase(const ContactSurface& surface, const PairTable& pairs, const LaggedSurface& lagged, const BroadPhase& broad_phase)
    : surface_(surface), pairs_(pairs), lagged_(lagged), sides_(pairs), overlap_(surface, pairs, lagged_),
      broad_phase_(broad_phase), rods_(surface, pairs) {}

bool NarrowPhase::may_integrate(const PointGroup& group) const {
  const int own = surface_.mesh.vertex_object[group.point];
  return pairs_.point(own, group.object).law >= 0 && pairs_.may_carry_pressure(own, group.object) &&
         !lagged_.topology().triangles_at(group.point).empty();
}

// Returns the groups that integrate and have no patches in this step yet. changed: only groups with
// changed primitives may have none; null: any group.
std::vector<PointGroup> NarrowPhase::groups_without_patches(const ChangedPrimitives* changed) const {
  const auto may_be_new = [&](const PointGroup& g) {
    return !changed || changed->vertices[g.point] || changed->objects[g.object];
  };
  const std::vector<PointGroup>& groups = groups_.groups;
  const int n = static_cast<int>(groups.size());
  std::vector<std::vector<PointGroup>> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    SortedCursor<GroupPatches> known(patches_), later(later_patches_);
    for (int i = first; i < last; ++i)
      if (may_be_new(groups[i]) && may_integrate(groups[i]) && !known.find(groups[i].key()) && !later.find(groups[i].key())) chunks[c].push_back(groups[i]);
  });
  std::vector<PointGroup> all;
  concatenate(chunks, all);
  return all;
}

// Finds the visible patches of groups. later: whether overlaps of this step are known: then patches
// have only the area whose overlap is unknown.
std::vector<GroupPatches> NarrowPhase::find_patches(const Candidates& candidates, const std::vector<PointGroup>& groups, bool later) const {
  std::vector<GroupPatches> found(groups.size());
  for_each_chunk(static_cast<int>(groups.size()), [&](int, int first, int last) {
    PatchFinder finder(surface_.mesh, lagged_);
    for (int i = first; i < last; ++i) {
      const PointGroup& g = groups[i];
      found[i] = {g.point, g.object, finder.find(finder.at_vertex(g.point), g.triangle_end - g.triangle_begin,
                                                [&](int k) { return candidates.point_triangle[g.triangle_begin + k][1]; })};
      if (!later || !overlap_.uses_overlap(surface_.mesh.vertex_object[g.point], g.object, sides_)) continue;
      VisiblePatches& visible = found[i].visible;
      for (int k = 0; k < visible.count; ++k) visible.patches[k].area = overlap_.unknown_area(g.point, g.object, visible.patches[k].normal);
    }
  });
  return found;
}

// Chooses the pairs of edges that press, and their laws. Edges of one object that are neighbours at
// rest do not press. changed: pairs without changed edges keep their law; null: none does.
void NarrowPhase::choose_edges(const Candidates& candidates, const ChangedPrimitives* changed) {
  constexpr int chunk = 4096;
  const CollisionMesh& mesh = surface_.mesh;
  // Returns the law of an edge-edge candidate; -1: it does not press.
  const auto law_of = [&, largest = pairs_.largest_edge_range()](int i) {
    if (candidates.distance_bounds.edge_edge[i] >= largest) return -1;
    const auto [ia, ib] = candidates.edge_edge[i];
    const Edge &a = mesh.edges[ia], &b = mesh.edges[ib];
    const int object = mesh.vertex_object[a[0]], other = mesh.vertex_object[b[0]];
    const PairRole& role = edge_role(mesh, pairs_, a, b);
    if (role.law < 0 || candidates.distance_bounds.edge_edge[i] >= role.range) return -1;
    if (object != other || pairs_.plain_sums || !close_at_rest(surface_, a, b, role.range)) return role.law;
    if (!surface_.rest_gaps || !surface_.rest_gaps->gap_between(a, b)) return -1;
    return surface_.rest_gaps->law_of_edges(role.law, a, b);
  };
  const int n = static_cast<int>(candidates.edge_edge.size());
  std::vector<std::vector<EdgePair>> chunks(chunk_count(n, chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    SortedCursor<EdgePair> before(edge_pairs_);
    for (int i = first; i < last; ++i) {
      const std::array<int, 2>& edges = candidates.edge_edge[i];
      const bool decided = changed && !changed->edges[edges[0]] && !changed->edges[edges[1]];
      const EdgePair* known = decided ? before.find(edges) : nullptr;
      const int law = known ? known->law : decided ? -1 : law_of(i);
      if (law >= 0) chunks[c].push_back({i, edges, law});
    }
  }, chunk);
  std::vector<EdgePair> all;
  concatenate(chunks, all);
  edge_pairs_ = std::move(all);
}

void NarrowPhase::prepare(const Candidates& candidates, const ChangedPrimitives* changed) {
  groups_.make(candidates, surface_.mesh);
  choose_edges(candidates, changed);
}

void NarrowPhase::set_candidates(const Candidates& candidates) {
  if (!begun_) {
    prepare(candidates);
    begin_step(candidates);
    return;
  }
  const ChangedPrimitives* changed = broad_phase_.changed();
  const PointGroups groups = std::move(groups_);
  prepare(candidates, changed);
  const std::vector<GroupPatches> found = find_patches(candidates, groups_without_patches(changed), true);
  std::vector<GroupPatches> all;
  std::merge(later_patches_.begin(), later_patches_.end(), found.begin(), found.end(), std::back_inserter(all),
             [](const GroupPatches& a, const GroupPatches& b) { return a.key() < b.key(); });
  later_patches_ = std::move(all);
  if (!changed) {
    make_lists(candidates, nullptr);
    return;
  }
  const EarlierVertexQuadrature earlier{groups, quadrature_, *changed};
  make_lists(candidates, &earlier);
}

void NarrowPhase::begin_step(const Candidates& candidates) {
  begun_ = true;
  weights_at_start_ = previous_weights_;
  patches_.clear();
  later_patches_.clear();
  patches_ = find_patches(candidates, groups_without_patches(nullptr), false);
  overlap_.choose_sides(patches_, sides_);
  if (overlap_.needed()) {
    overlap_.evaluate(sides_, broad_phase_, patches_);
    overlap_boundary_forces_.update(overlap_.facets(), pairs_, surface_.mesh, lagged_);
  }
  make_lists(candidates, nullptr);
}

// Makes the quadrature points and the patches of interior points. earlier: null: none in this step.
void NarrowPhase::make_lists(const Candidates& candidates, const EarlierVertexQuadrature* earlier) {
  if (!pairs_.plain_sums) rods_.find(candidates, lagged_);
  const VertexQuadratureRequest request{surface_, pairs_, lagged_, sides_, rods_, candidates, groups_, patches_, later_patches_, weights_at_start_};
  quadrature_ = make_vertex_quadrature(request, earlier);
  if (earlier) update_interior_patches(earlier->changed, overlap_.interior_points(), surface_.mesh, lagged_, broad_phase_, interior_patches_);
  else interior_patches_ = make_interior_patches(overlap_.interior_points(), surface_.mesh, lagged_, broad_phase_);
}

void NarrowPhase::set_free(std::vector<char> free) {
  free_ = {std::move(free), {}};
  if (free_.free.empty()) return;
  free_.one_ring = free_.free;
  for (const auto& [a, b] : surface_.mesh.edges) {
    free_.one_ring[a] |= free_.free[b];
    free_.one_ring[b] |= free_.free[a];
  }
}

void NarrowPhase::find(const Candidates& candidates, const VecX& x, ContactSet& contacts) {
  if (const std::vector<int> added = overlap_.subdivide_approached(x); !added.empty())
    add_interior_patches(added, overlap_.interior_points(), surface_.mesh, lagged_, broad_phase_, interior_patches_);
  const int points = static_cast<int>(quadrature_.points.size());
  const int edges = static_cast<int>(edge_pairs_.size());
  const DisplacementBounds displacements(surface_.mesh, [&](int v) { return (vertex(x, v) - vertex(candidates.reference, v)).norm(); });
  std::vector<FoundStencils> found_points(chunk_count(points)), found_edges(chunk_count(edges));
  for_each_chunk(points, [&](int c, int first, int last) {
    VertexSearch search(surface_, pairs_, candidates, displacements, quadrature_, free_, x, found_points[c]);
    for (int i = first; i < last; ++i) search.search(quadrature_.points[i]);
  });
  for_each_chunk(edges, [&](int c, int first, int last) {
    search_edges(surface_, pairs_, candidates, edge_pairs_, displacements, free_.free, x, first, last, found_edges[c]);
  });
  if (!rods_.crossings().empty())
    search_crossings(surface_, pairs_, rods_.crossings(), free_.free, x, found_edges.emplace_back());
  const int interior_points = static_cast<int>(overlap_.interior_points().size());
  std::vector<FoundStencils> found_interior(chunk_count(interior_points));
  for_each_chunk(interior_points, [&](int c, int first, int last) {
    InteriorSearch search(surface_, pairs_, overlap_.interior_points(), interior_patches_, free_, x, found_interior[c]);
    for (int i = first; i < last; ++i) search.search(i);
  });
  join(found_interior, &FoundStencils::interior_point, contacts.interior_point);
  join(found_interior, &FoundStencils::interior_edge, contacts.interior_edge);
  join(found_interior, &FoundStencils::interior_triangle, contacts.interior_triangle);
  join(found_points, &FoundStencils::point_point, contacts.point_point);
  join(found_points, &FoundStencils::point_edge, contacts.point_edge);
  join(found_points, &FoundStencils::point_triangle, contacts.point_triangle);
  join(found_edges, &FoundStencils::edge_edge, contacts.edge_edge);
  contacts.mollifier_threshold.clear();
  for (const auto& s : contacts.edge_edge)
    contacts.mollifier_threshold.push_back(edge_edge_mollifier_threshold(
        vertex(surface_.rest, s.vertices[0]), vertex(surface_.rest, s.vertices[1]),
        vertex(surface_.rest, s.vertices[2]), vertex(surface_.rest, s.vertices[3])));
}

}  // namespace tack
