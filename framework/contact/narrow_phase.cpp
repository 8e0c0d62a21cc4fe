#include "framework/contact/narrow_phase.hpp"

#include <algorithm>
#include <iterator>
#include <span>

#include "framework/contact/sorted_cursor.hpp"
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

using Found = ContactSet;  // of one chunk, without thresholds; chunks are joined in order

// Base of the searches for stencils of points and of samples.
class StencilSearch {
 protected:
  StencilSearch(const CollisionMesh& mesh, const PairTable& pairs, const FreeVertices& free, const VecX& x,
                Found& found)
      : mesh_(mesh), pairs_(pairs), x_(x), found_(found), free_(free) {}

  // Own: the vertices of the point, before those of what it is near.
  template <int Own, class Stencil>
  void keep(std::vector<Stencil>& stencils, const std::type_identity_t<Stencil>& stencil) {
    const std::span<const int> all(stencil.vertices);
    if (any_of(free_.free, all.first(Own)) || any_of(free_.beside, all.subspan(Own))) stencils.push_back(stencil);
  }

  const CollisionMesh& mesh_;
  const PairTable& pairs_;
  const VecX& x_;
  Found& found_;
  PointFeatures features_;
  std::vector<Triangle> triangles_;

 private:
  const FreeVertices& free_;
};

class PointSearch : StencilSearch {
 public:
  PointSearch(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates, const DisplacementBounds& displacements,
              const PointPieces& pieces, const FreeVertices& free, const VecX& x, Found& found)
      : StencilSearch(surface.mesh, pairs, free, x, found), candidates_(candidates), displacements_(displacements), pieces_(pieces) {}

  void search(const PointPiece& piece) {
    triangles_.clear();
    shares_.clear();
    for (int i = piece.triangle_begin; i < piece.triangle_end; ++i) {
      const int candidate = pieces_.triangles[i], t = candidates_.point_triangle[candidate][1];
      const double displacement = displacements_.vertex(piece.point) + displacements_.triangle(t);
      if (!(candidates_.reference_distances.point_triangle[candidate] - displacement < piece.range)) continue;
      triangles_.push_back(mesh_.triangles[t]);
      if (piece.share_begin >= 0) shares_.push_back(pieces_.shares[piece.share_begin + i - piece.triangle_begin]);
    }
    if (piece.share_begin >= 0) {
      for (const PointFeature& f : features_.reduce(x_, vertex(x_, piece.point), triangles_, shares_, piece.range))
        add(piece.point, f, piece.law, piece.area * f.multiplicity);
      return;
    }
    if (triangles_.empty() && piece.edge_begin == piece.edge_end && piece.other_begin == piece.other_end) return;
    edges_.clear();
    for (int i = piece.edge_begin; i < piece.edge_end; ++i) edges_.push_back(mesh_.edges[pieces_.edges[i]]);
    const std::span<const int> others(pieces_.others.data() + piece.other_begin, pieces_.others.data() + piece.other_end);
    for (const PointFeature& f : features_.reduce(x_, vertex(x_, piece.point), triangles_, edges_, others, piece.range,
                                                  pairs_.plain_sums))
      add(piece.point, f, piece.law, piece.area * f.multiplicity);
  }

 private:
  void add(int p, const PointFeature& f, int law, double weight) {
    const auto& v = f.vertices;
    switch (f.count()) {
      case 1: keep<1>(found_.point_point, {{p, v[0]}, law, weight}); break;
      case 2: keep<1>(found_.point_edge, {{p, v[0], v[1]}, law, weight}); break;
      default: keep<1>(found_.point_triangle, {{p, v[0], v[1], v[2]}, law, weight});
    }
  }

  const Candidates& candidates_;
  const DisplacementBounds& displacements_;
  const PointPieces& pieces_;
  std::vector<TriangleWeight> shares_;
  std::vector<Edge> edges_;
};

class SampleSearch : StencilSearch {
 public:
  SampleSearch(const ContactSurface& surface, const PairTable& pairs, const std::vector<ContactSample>& samples,
               const SamplePieces& pieces, const FreeVertices& free, const VecX& x, Found& found)
      : StencilSearch(surface.mesh, pairs, free, x, found), samples_(samples), pieces_(pieces) {}

  void search(int i) {
    const ContactSample& sample = samples_[i];
    const Triangle& own = mesh_.triangles[sample.triangle];
    const PairRole& role = pairs_.point(mesh_.vertex_object[own[0]], sample.object, sample.region_pair);
    triangles_.clear();
    for (int k = pieces_.pieces[i].begin; k < pieces_.pieces[i].end; ++k) triangles_.push_back(mesh_.triangles[pieces_.triangles[k]]);
    const Vec3 p = point_inside(x_, own, sample.inside);
    for (const PointFeature& f : features_.reduce(x_, p, triangles_, {}, {}, role.range, false)) {
      const auto [a, b, c] = own;
      const auto& v = f.vertices;
      const double weight = role.area_factor * sample.area * f.multiplicity;
      switch (f.count()) {
        case 1: keep<3>(found_.sample_point, {{a, b, c, v[0]}, role.law, weight, sample.inside, i}); break;
        case 2: keep<3>(found_.sample_edge, {{a, b, c, v[0], v[1]}, role.law, weight, sample.inside, i}); break;
        default: keep<3>(found_.sample_triangle, {{a, b, c, v[0], v[1], v[2]}, role.law, weight, sample.inside, i});
      }
    }
  }

 private:
  const std::vector<ContactSample>& samples_;
  const SamplePieces& pieces_;
};

const PairRole& edge_role(const CollisionMesh& mesh, const PairTable& pairs, const Edge& a, const Edge& b) {
  const int object = mesh.vertex_object[a[0]], other = mesh.vertex_object[b[0]];
  return pairs.edge(object, other, pairs.region_pair(object, other, a, b));
}

// Returns the area of a pair of edges. An edge without width has no area, and does not count here.
double shared_area(double a, double b, double most_uneven) {
  const auto [least, most] = std::minmax(a, b);
  return least > 0 ? least + std::min(most, most_uneven * least) : most;
}

void search_edges(const ContactSurface& surface, const PairTable& pairs, const Candidates& candidates,
                  const std::vector<EdgePair>& edge_pairs, const DisplacementBounds& displacements, const std::vector<char>& free, const VecX& x,
                  int first, int last, Found& found) {
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
                      const std::vector<char>& free, const VecX& x, Found& found) {
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
void join(const std::vector<Found>& chunks, Stencils Found::* member, Stencils& all) {
  all.clear();
  for (const Found& chunk : chunks)
    all.insert(all.end(), (chunk.*member).begin(), (chunk.*member).end());
  const auto by_law = [](const auto& a, const auto& b) { return a.law < b.law; };
  if (!std::is_sorted(all.begin(), all.end(), by_law)) std::stable_sort(all.begin(), all.end(), by_law);
}

}  // namespace

NarrowPhase::NarrowPhase(const ContactSurface& surface, const PairTable& pairs, const BroadPhase& broad_phase)
    : surface_(surface), pairs_(pairs), held_(surface), sides_(pairs), overlap_(surface, pairs, held_),
      broad_phase_(broad_phase), rods_(surface, pairs) {}

bool NarrowPhase::may_integrate(const PointGroup& group) const {
  const int own = surface_.mesh.vertex_object[group.point];
  return pairs_.point(own, group.object).law >= 0 && pairs_.may_carry_pressure(own, group.object) &&
         !held_.topology().triangles_at(group.point).empty();
}

// The groups that integrate and have no view in this step yet. changed: others have one; null: any may have none.
std::vector<PointGroup> NarrowPhase::unseen(const ChangedPrimitives* changed) const {
  const auto may_be_new = [&](const PointGroup& g) {
    return !changed || changed->vertices[g.point] || changed->objects[g.object];
  };
  const std::vector<PointGroup>& groups = groups_.groups;
  const int n = static_cast<int>(groups.size());
  std::vector<std::vector<PointGroup>> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    SortedCursor<GroupView> known(views_), later(later_views_);
    for (int i = first; i < last; ++i)
      if (may_be_new(groups[i]) && may_integrate(groups[i]) && !known.find(groups[i].key()) && !later.find(groups[i].key())) chunks[c].push_back(groups[i]);
  });
  std::vector<PointGroup> all;
  concatenate(chunks, all);
  return all;
}

// later: than what is covered was found.
std::vector<GroupView> NarrowPhase::look(const Candidates& candidates, const std::vector<PointGroup>& groups, bool later) const {
  std::vector<GroupView> seen(groups.size());
  for_each_chunk(static_cast<int>(groups.size()), [&](int, int first, int last) {
    FacingViewer viewer(surface_.mesh, held_);
    for (int i = first; i < last; ++i) {
      const PointGroup& g = groups[i];
      seen[i] = {g.point, g.object, viewer.look(viewer.vertex_view(g.point), g.triangle_end - g.triangle_begin,
                                                [&](int k) { return candidates.point_triangle[g.triangle_begin + k][1]; })};
      if (!later || !overlap_.weighs(surface_.mesh.vertex_object[g.point], g.object, sides_)) continue;
      FacingView& view = seen[i].view;
      for (int k = 0; k < view.count; ++k) view.pieces[k].area = overlap_.unknown_area(g.point, g.object, view.pieces[k].normal);
    }
  });
  return seen;
}

// Edges of one object that are neighbours at rest do not press. changed: for others it stays as it was decided.
void NarrowPhase::choose_edges(const Candidates& candidates, const ChangedPrimitives* changed) {
  constexpr int chunk = 4096;
  const CollisionMesh& mesh = surface_.mesh;
  // The law of a pair of candidates; -1: it does not press.
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

void NarrowPhase::take(const Candidates& candidates, const ChangedPrimitives* changed) {
  groups_.make(candidates, surface_.mesh);
  choose_edges(candidates, changed);
}

void NarrowPhase::set_candidates(const Candidates& candidates, const VecX& x) {
  if (!held_.held()) {
    take(candidates);
    begin_step(candidates, x);
    return;
  }
  const ChangedPrimitives* changed = broad_phase_.changed();
  const PointGroups groups = std::move(groups_);
  take(candidates, changed);
  const std::vector<GroupView> seen = look(candidates, unseen(changed), true);
  std::vector<GroupView> all;
  std::merge(later_views_.begin(), later_views_.end(), seen.begin(), seen.end(), std::back_inserter(all),
             [](const GroupView& a, const GroupView& b) { return a.key() < b.key(); });
  later_views_ = std::move(all);
  if (!changed) {
    make_lists(candidates, nullptr);
    return;
  }
  const EarlierPieces earlier{groups, pieces_, *changed};
  make_lists(candidates, &earlier);
}

void NarrowPhase::begin_step(const Candidates& candidates, const VecX& x) {
  held_.hold(x);
  shares_at_start_ = shares_before_;
  views_.clear();
  later_views_.clear();
  views_ = look(candidates, unseen(nullptr), false);
  overlap_.capture(views_, sides_);
  if (overlap_.wanted()) {
    overlap_.weigh(sides_, broad_phase_, views_);
    overlap_boundary_forces_.take(overlap_.parts(), pairs_, surface_.mesh, held_);
  }
  make_lists(candidates, nullptr);
}

// earlier: null: all is new.
void NarrowPhase::make_lists(const Candidates& candidates, const EarlierPieces* earlier) {
  if (!pairs_.plain_sums) rods_.find(candidates, held_);
  const PieceRequest request{surface_, pairs_, held_, sides_, rods_, candidates, groups_, views_, later_views_, shares_at_start_};
  pieces_ = make_pieces(request, earlier);
  if (earlier) renew_sample_pieces(earlier->changed, overlap_.samples(), surface_.mesh, held_, broad_phase_, sample_pieces_);
  else sample_pieces_ = make_sample_pieces(overlap_.samples(), surface_.mesh, held_, broad_phase_);
}

void NarrowPhase::set_free(std::vector<char> free) {
  free_ = {std::move(free), {}};
  if (free_.free.empty()) return;
  free_.beside = free_.free;
  for (const auto& [a, b] : surface_.mesh.edges) {
    free_.beside[a] |= free_.free[b];
    free_.beside[b] |= free_.free[a];
  }
}

void NarrowPhase::find(const Candidates& candidates, const VecX& x, ContactSet& contacts) {
  if (const std::vector<int> added = overlap_.approach(x); !added.empty())
    add_sample_pieces(added, overlap_.samples(), surface_.mesh, held_, broad_phase_, sample_pieces_);
  const int points = static_cast<int>(pieces_.pieces.size());
  const int edges = static_cast<int>(edge_pairs_.size());
  const DisplacementBounds displacements(surface_.mesh, [&](int v) { return (vertex(x, v) - vertex(candidates.reference, v)).norm(); });
  std::vector<Found> found_points(chunk_count(points)), found_edges(chunk_count(edges));
  for_each_chunk(points, [&](int c, int first, int last) {
    PointSearch search(surface_, pairs_, candidates, displacements, pieces_, free_, x, found_points[c]);
    for (int i = first; i < last; ++i) search.search(pieces_.pieces[i]);
  });
  for_each_chunk(edges, [&](int c, int first, int last) {
    search_edges(surface_, pairs_, candidates, edge_pairs_, displacements, free_.free, x, first, last, found_edges[c]);
  });
  if (!rods_.crossings().empty())
    search_crossings(surface_, pairs_, rods_.crossings(), free_.free, x, found_edges.emplace_back());
  const int samples = static_cast<int>(overlap_.samples().size());
  std::vector<Found> found_samples(chunk_count(samples));
  for_each_chunk(samples, [&](int c, int first, int last) {
    SampleSearch search(surface_, pairs_, overlap_.samples(), sample_pieces_, free_, x, found_samples[c]);
    for (int i = first; i < last; ++i) search.search(i);
  });
  join(found_samples, &Found::sample_point, contacts.sample_point);
  join(found_samples, &Found::sample_edge, contacts.sample_edge);
  join(found_samples, &Found::sample_triangle, contacts.sample_triangle);
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
