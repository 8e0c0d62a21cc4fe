#include "framework/contact/area_integral/narrow_phase.hpp"

#include <algorithm>
#include <optional>

#include "framework/contact/area_integral/weighted_features.hpp"
#include "framework/contact/stencils/rest_neighbours.hpp"
#include "framework/contact/stencils/sorted_cursor.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/merge_sorted.hpp"
#include "geometry/parallel.hpp"
#include "geometry/parallel_loops.hpp"

namespace tack {
namespace {

constexpr int groups_per_chunk = 64;  // of loops over points and opposite objects

class VertexSearch : PointSearch {
 public:
  // displacements: null: all triangles of a point are looked at.
  VertexSearch(const ContactSurface& surface, const Candidates& candidates, const DisplacementBounds* displacements,
               const VertexQuadrature& quadrature, const FreeVertices& free, const VecX& x, FoundStencils& found)
      : PointSearch(surface.mesh, free, x, found), candidates_(candidates), displacements_(displacements), quadrature_(quadrature) {}

  void search(const VertexQuadraturePoint& point) {
    triangles_.clear();
    weights_.clear();
    for (int i = point.triangle_begin; i < point.triangle_end; ++i) {
      const int candidate = quadrature_.triangles[i], t = candidates_.point_triangle[candidate][1];
      if (displacements_ &&
          !(candidates_.reference_distances.point_triangle[candidate] - (displacements_->vertex(point.point) + displacements_->triangle(t)) < point.range))
        continue;
      triangles_.push_back(mesh_.triangles[t]);
      if (point.weight_begin >= 0) weights_.push_back(quadrature_.weights[point.weight_begin + i - point.triangle_begin]);
    }
    if (point.weight_begin >= 0) {
      for (const PointFeature& f : features_.reduce(x_, vertex(x_, point.point), triangles_, weights_, point.range))
        add(point.point, f, point.law, point.contact_point, point.area * f.multiplicity);
      return;
    }
    if (triangles_.empty() && point.edge_begin == point.edge_end && point.other_begin == point.other_end) return;
    edges_.clear();
    for (int i = point.edge_begin; i < point.edge_end; ++i) edges_.push_back(mesh_.edges[quadrature_.edges[i]]);
    const std::span<const int> others(quadrature_.others.data() + point.other_begin, quadrature_.others.data() + point.other_end);
    for (const PointFeature& f : features_.reduce(x_, vertex(x_, point.point), triangles_, edges_, others, point.range,
                                                  FeatureCount::inclusion_exclusion))
      add(point.point, f, point.law, point.contact_point, point.area * f.multiplicity);
  }

 private:
  const Candidates& candidates_;
  const DisplacementBounds* displacements_;
  const VertexQuadrature& quadrature_;
  WeightedFeatures features_;
  std::vector<TriangleWeight> weights_;
  std::vector<Edge> edges_;
};

class InteriorSearch : PointSearch {
 public:
  InteriorSearch(const ContactSurface& surface, const PairTable& pairs, const std::vector<InteriorPoint>& points,
                 const InteriorPatches& patches, const FreeVertices& free, const VecX& x, FoundStencils& found)
      : PointSearch(surface.mesh, free, x, found), pairs_(pairs), points_(points), patches_(patches) {}

  void search(int i) {
    const InteriorPoint& point = points_[i];
    const Triangle& own = mesh_.triangles[point.triangle];
    const PairRole& role = pairs_.point(mesh_.vertex_object[own[0]], point.object, point.region_pair);
    triangles_.clear();
    for (int k = patches_.ranges[i].begin; k < patches_.ranges[i].end; ++k) triangles_.push_back(mesh_.triangles[patches_.triangles[k]]);
    const Vec3 p = point_inside(x_, own, point.inside);
    for (const PointFeature& f : features_.reduce(x_, p, triangles_, {}, {}, role.range, FeatureCount::inclusion_exclusion)) {
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
  const PairTable& pairs_;
  PointFeatures features_;
  const std::vector<InteriorPoint>& points_;
  const InteriorPatches& patches_;
};

// Finds the stencils of crossing rods, weighted with the area of their overlap. crossings: of rods.
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
    found.edge_edge.push_back({{a[0], a[1], b[0], b[1]}, law, -1, area});
  }
}

}  // namespace

NarrowPhase::NarrowPhase(const ContactSurface& surface, const PairTable& pairs, const IntegrationRules& rules, const LaggedSurface& lagged, const BroadPhase& broad_phase)
    : surface_(surface), pairs_(pairs), rules_(rules), lagged_(lagged), sides_(pairs, rules), overlap_(surface, pairs, rules, lagged_),
      broad_phase_(broad_phase), edges_(surface, pairs, EdgePairs::RestNeighbours::do_not_press), rods_(surface, pairs) {}

bool NarrowPhase::may_integrate(const PointGroup& group) const {
  const int own = surface_.mesh.vertex_object[group.point];
  return pairs_.point(own, group.object).law >= 0 && rules_.may_carry_pressure(own, group.object, pairs_) &&
         !lagged_.topology().triangles_at(group.point).empty();
}

// Sets the index of the patches of each group; -1: it has none yet.
void NarrowPhase::look_up_patches(const std::vector<PointGroup>& groups) {
  patches_of_group_.resize(groups.size());
  for_each_chunk(static_cast<int>(groups.size()), [&](int, int first, int last) {
    SortedCursor<PatchesOf> known(patch_index_);
    for (int i = first; i < last; ++i) {
      const PatchesOf* found = known.find(groups[i].key());
      patches_of_group_[i] = found ? found->patches : -1;
    }
  });
}

// Finds the patches of the groups that integrate and have none in this step yet. later: overlaps of
// this step are known; then patches have only the area whose overlap is unknown.
void NarrowPhase::add_patches(const Candidates& candidates, bool later) {
  const std::vector<PointGroup>& groups = candidates.groups.all;
  look_up_patches(groups);
  const int n = static_cast<int>(groups.size());
  std::vector<std::vector<GroupPatches>> chunks(chunk_count(n, groups_per_chunk));
  for_each_chunk(n, [&](int c, int first, int last) {
    std::optional<PatchFinder> finder;
    for (int i = first; i < last; ++i) {
      const PointGroup& g = groups[i];
      if (patches_of_group_[i] >= 0 || !may_integrate(g)) continue;
      if (!finder) finder.emplace(surface_.mesh, lagged_);
      GroupPatches& found = chunks[c].emplace_back(GroupPatches{g.point, g.object, finder->find(finder->at_vertex(g.point), g.triangle_end - g.triangle_begin,
                                                                                                [&](int k) { return candidates.point_triangle[g.triangle_begin + k][1]; })});
      if (!later || !overlap_.uses_overlap(surface_.mesh.vertex_object[g.point], g.object, sides_)) continue;
      for (int k = 0; k < found.visible.count; ++k) {
        VisiblePatch& patch = found.visible.patches[k];
        patch.area = overlap_.unknown_area(g.point, g.object, patch.normal);
      }
    }
  }, groups_per_chunk);
  std::vector<PatchesOf> added;
  for (const std::vector<GroupPatches>& chunk : chunks)
    for (const GroupPatches& patches : chunk) added.push_back({patches.key(), static_cast<int>(patches_.size() + added.size())});
  if (added.empty()) return;
  append(chunks, patches_);
  patch_index_ = merge_sorted(patch_index_, added, [](const PatchesOf& p) { return p.key(); });
  look_up_patches(groups);
}

void NarrowPhase::prepare(const Candidates& candidates, const ChangedPrimitives* changed) { edges_.choose(candidates, changed); }

void NarrowPhase::set_candidates(const Candidates& candidates) {
  if (!begun_) {
    prepare(candidates);
    begin_step(candidates);
    return;
  }
  const ChangedPrimitives* changed = broad_phase_.changed();
  prepare(candidates, changed);
  add_patches(candidates, true);
  if (!changed) {
    make_lists(candidates, nullptr);
    return;
  }
  const EarlierVertexQuadrature earlier{quadrature_, *changed};
  make_lists(candidates, &earlier);
}

void NarrowPhase::begin_step(const Candidates& candidates) {
  begun_ = true;
  weights_at_start_ = previous_weights_;
  patches_.clear();
  patch_index_.clear();
  add_patches(candidates, false);
  overlap_.choose_sides(patches_, sides_);
  if (overlap_.needed()) {
    overlap_.evaluate(sides_, broad_phase_, patches_);
    overlap_boundary_forces_.update(overlap_.facets(), pairs_, surface_.mesh, lagged_);
  }
  make_lists(candidates, nullptr);
}

// Makes the quadrature points and the patches of interior points. earlier: null: none in this step.
void NarrowPhase::make_lists(const Candidates& candidates, const EarlierVertexQuadrature* earlier) {
  item_maps_.reset();
  rods_.find(candidates, lagged_);
  const VertexQuadratureRequest request{surface_, pairs_, rules_, lagged_, sides_, rods_, candidates, patches_, patches_of_group_, weights_at_start_};
  make_vertex_quadrature(request, earlier, earlier_quadrature_);
  std::swap(quadrature_, earlier_quadrature_);
  if (earlier) update_interior_patches(earlier->changed, overlap_, surface_.mesh, lagged_, broad_phase_, interior_patches_);
  else interior_patches_ = make_interior_patches(overlap_, surface_.mesh, lagged_, broad_phase_);
}

void NarrowPhase::find(const Candidates& candidates, const VecX& x, ContactSet& contacts) {
  if (const std::vector<int> added = overlap_.subdivide_approached(x); !added.empty())
    add_interior_patches(added, overlap_, surface_.mesh, lagged_, broad_phase_, interior_patches_);
  const int points = static_cast<int>(quadrature_.points.size()), interior_points = static_cast<int>(overlap_.interior_points().size());
  const DisplacementBounds displacements(surface_.mesh, [&](int v) { return (vertex(x, v) - vertex(candidates.reference, v)).norm(); });
  FoundChunks found;
  found.points.resize(chunk_count(points));
  found.edges.resize(chunk_count(edges_.size()));
  found.interior.resize(chunk_count(interior_points));
  ParallelLoops loops;
  loops.add(points, [&](int c, int first, int last) {
    VertexSearch search(surface_, candidates, &displacements, quadrature_, free_, x, found.points[c]);
    for (int i = first; i < last; ++i) search.search(quadrature_.points[i]);
  });
  loops.add(edges_.size(), [&](int c, int first, int last) {
    edges_.search(candidates, displacements, free_.free, x, first, last, surface_.edge_area, found.edges[c]);
  });
  loops.add(interior_points, [&](int c, int first, int last) {
    InteriorSearch search(surface_, pairs_, overlap_.interior_points(), interior_patches_, free_, x, found.interior[c]);
    for (int i = first; i < last; ++i) search.search(i);
  });
  loops.run();
  if (!rods_.crossings().empty())
    search_crossings(surface_, pairs_, rods_.crossings(), free_.free, x, found.edges.emplace_back());
  join(std::move(found), surface_.rest, contacts);
  contacts.point_count = quadrature_.contact_point_count;
  contacts.interior_point_count = interior_points;
}

// Calls act(vertex) for each vertex of the primitives that a quadrature point acts on, and for its
// own.
template <class Act>
void NarrowPhase::for_each_vertex(const Candidates& candidates, int point, const Act& act) const {
  const CollisionMesh& mesh = surface_.mesh;
  const VertexQuadraturePoint& p = quadrature_.points[point];
  act(p.point);
  for (int i = p.triangle_begin; i < p.triangle_end; ++i)
    for (const int v : mesh.triangles[candidates.point_triangle[quadrature_.triangles[i]][1]]) act(v);
  for (int i = p.edge_begin; i < p.edge_end; ++i)
    for (const int v : mesh.edges[quadrature_.edges[i]]) act(v);
  for (int i = p.other_begin; i < p.other_end; ++i) act(quadrature_.others[i]);
}

template <class Act>
void NarrowPhase::for_each_vertex_of_interior(int point, const Act& act) const {
  const CollisionMesh& mesh = surface_.mesh;
  for (const int v : mesh.triangles[overlap_.interior_points()[point].triangle]) act(v);
  for (int k = interior_patches_.ranges[point].begin; k < interior_patches_.ranges[point].end; ++k)
    for (const int v : mesh.triangles[interior_patches_.triangles[k]]) act(v);
}

LocalItems NarrowPhase::touching(const Candidates& candidates, std::span<const int> moved) {
  const CollisionMesh& mesh = surface_.mesh;
  const int vertices = static_cast<int>(mesh.vertex_object.size());
  const size_t interior_points = overlap_.interior_points().size();
  if (!item_maps_ || item_maps_->interior_points != interior_points) {
    item_maps_.emplace();
    item_maps_->interior_points = interior_points;
    item_maps_->points = VertexItems(vertices, [&](const auto& act) {
      for (int i = 0; i < static_cast<int>(quadrature_.points.size()); ++i) for_each_vertex(candidates, i, [&](int v) { act(i, v); });
    });
    item_maps_->edges = VertexItems(vertices, [&](const auto& act) {
      for (int i = 0; i < edges_.size(); ++i)
        for (const int e : edges_.edges(i))
          for (const int v : mesh.edges[e]) act(i, v);
    });
    item_maps_->interior = VertexItems(vertices, [&](const auto& act) {
      for (int i = 0; i < static_cast<int>(interior_points); ++i) for_each_vertex_of_interior(i, [&](int v) { act(i, v); });
    });
  }
  LocalItems items{item_maps_->points.touching(moved), item_maps_->edges.touching(moved), item_maps_->interior.touching(moved), {}, {}};
  const auto add = [&](int v) { items.vertices.push_back(v); };
  for (const int i : items.points) for_each_vertex(candidates, i, add);
  for (const int i : items.edges)
    for (const int e : edges_.edges(i))
      for (const int v : mesh.edges[e]) add(v);
  for (const int i : items.interior) for_each_vertex_of_interior(i, add);
  for (const RodOverlaps::Crossing& crossing : rods_.crossings()) {
    const Edge &a = mesh.edges[crossing.edges[0]], &b = mesh.edges[crossing.edges[1]];
    const std::array all{a[0], a[1], b[0], b[1]};
    if (std::none_of(all.begin(), all.end(), [&](int v) { return std::binary_search(moved.begin(), moved.end(), v); })) continue;
    items.crossings.push_back(crossing);
    for (const int v : all) add(v);
  }
  std::sort(items.vertices.begin(), items.vertices.end());
  items.vertices.erase(std::unique(items.vertices.begin(), items.vertices.end()), items.vertices.end());
  return items;
}

void NarrowPhase::find(const LocalItems& items, const Candidates& candidates, const VecX& x, ContactSet& contacts) const {
  FoundChunks found{std::vector<FoundStencils>(1), std::vector<FoundStencils>(2), std::vector<FoundStencils>(1)};
  VertexSearch points(surface_, candidates, nullptr, quadrature_, free_, x, found.points[0]);
  for (const int i : items.points) points.search(quadrature_.points[i]);
  for (const int i : items.edges) edges_.search(free_.free, x, i, surface_.edge_area, found.edges[0]);
  if (!items.crossings.empty()) search_crossings(surface_, pairs_, items.crossings, free_.free, x, found.edges[1]);
  InteriorSearch interior(surface_, pairs_, overlap_.interior_points(), interior_patches_, free_, x, found.interior[0]);
  for (const int i : items.interior) interior.search(i);
  join(std::move(found), surface_.rest, contacts);
}

}  // namespace tack
