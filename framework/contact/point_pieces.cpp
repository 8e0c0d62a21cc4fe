#include "framework/contact/point_pieces.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "framework/contact/sorted_cursor.hpp"
#include "framework/contact/point_features.hpp"
#include "framework/contact/rest_neighbours.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double little = 0.1;  // of the area of a rod or particle: what has less is guarded against as well

// Makes the pieces of one chunk of groups.
class PieceMaker {
 public:
  // Makes the pieces of groups in ascending order.
  PieceMaker(const PieceRequest& r, const EarlierPieces* earlier)
      : r_(r), mesh_(r.surface.mesh), earlier_(earlier), viewer_(mesh_, r.held), thin_viewer_(mesh_, r.held), views_(r.views),
        later_views_(r.later_views), earlier_groups_(earlier ? earlier->groups.groups : r.groups.groups) {}

  void add(int g) {
    const PointGroup& group = r_.groups.groups[g];
    out_.group_begin.push_back(static_cast<int>(out_.pieces.size()));
    if (!repeat(group)) make(group);
  }
  PointPieces take() { return std::move(out_); }

 private:
  void make(const PointGroup& group) {
    const int own = mesh_.vertex_object[group.point];
    region_pair_ = nearest_region_pair(group, own);
    const PairRole& role = r_.pairs.point(own, group.object, region_pair_);
    if (role.law < 0) return;
    if (r_.pairs.plain_sums) {
      add_all(group, {role.law, role.range, role.area_factor * whole(group.point)});
      return;
    }
    if (!topology().triangles_at(group.point).empty()) {
      if (r_.sides.integrates(own, group.object)) add_pressure(group, role);
      else add_guard(group, guard_of(role), r_.held.whole(group.point));
    }
    if (topology().thin(group.point) && group.triangle_end > group.triangle_begin) add_thin(group, role);
    if (has_rods_or_particles(group)) add_rods_and_particles(group, role);
  }

  // Takes the pieces of a group of triangles that are what they were, if there are any; rods and particles share with what may have changed.
  bool repeat(const PointGroup& group) {
    if (!earlier_ || has_rods_or_particles(group) || topology().thin(group.point)) return false;
    const ChangedPrimitives& changed = earlier_->changed;
    if (changed.vertices[group.point] || changed.objects[group.object]) return false;
    const PointGroup* before = earlier_groups_.find(group.key());
    if (!before) return false;
    const PointPieces& pieces = earlier_->pieces;
    const auto number = before - earlier_->groups.groups.data();
    const int shift = group.triangle_begin - before->triangle_begin;
    for (int k = pieces.group_begin[number]; k < pieces.group_begin[number + 1]; ++k) {
      const PointPiece& piece = pieces.pieces[k];
      begin(group, {piece.law, piece.range, piece.area});
      for (int i = piece.triangle_begin; i < piece.triangle_end; ++i) out_.triangles.push_back(pieces.triangles[i] + shift);
      end();
    }
    return true;
  }

  struct Acting {
    int law;
    double range, area;
  };
  struct NearTriangle {
    int candidate, piece;  // of the group's view; -1: none
  };
  struct Guard {
    int law;  // -1: none
    double range;
  };

  // That of what is nearest of the group.
  int nearest_region_pair(const PointGroup& group, int own) const {
    if (!r_.pairs.has_regions(own, group.object)) return -1;
    const VecX& x = r_.held.x();
    const std::array point{group.point};
    double nearest = std::numeric_limits<double>::infinity();
    int region_pair = -1;
    const auto look = [&](const auto& element) {
      const double squared = squared_distance(corners(x, point), corners(x, element));
      if (squared < nearest) nearest = squared, region_pair = r_.pairs.region_pair(own, group.object, point, element);
    };
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) look(mesh_.triangles[triangle(i)]);
    for (int i = group.edge_begin; i < group.edge_end; ++i) look(mesh_.edges[rod(i)]);
    for (int i = group.other_begin; i < group.other_end; ++i) look(std::array{particle(i)});
    return region_pair;
  }

  const SurfaceTopology& topology() const { return r_.held.topology(); }
  double whole(int point) const {
    return r_.held.whole(point) + (topology().thin(point) ? r_.held.thin(point) : 0);
  }
  // Returns the safety barrier of a side that carries pressure, or the law of one that does not.
  static Guard guard_of(const PairRole& role) {
    if (role.carries_pressure) return {role.safety_barrier, role.safety_barrier_range};
    return {role.law, role.range};
  }
  int triangle(int i) const { return r_.candidates.point_triangle[i][1]; }
  int rod(int i) const { return r_.candidates.point_edge[i][1]; }
  int particle(int i) const { return r_.groups.particles[i][1]; }
  // Returns whether the pair may come within a range [m] while the candidates are valid.
  bool reaches(int i, double range) const { return r_.candidates.distance_bounds.point_triangle[i] < range; }

  // Within one object the law is the one that presses from rest on.
  void begin(const PointGroup& group, Acting acting) {
    if (const RestGaps* gaps = r_.surface.rest_gaps.get(); gaps && within_object(group))
      if (const int law = gaps->law_of_point(acting.law, group.point); law != acting.law) acting = {law, gaps->range(law), acting.area};
    const auto end = [](const std::vector<int>& list) { return static_cast<int>(list.size()); };
    const int t = end(out_.triangles), e = end(out_.edges), o = end(out_.others);
    out_.pieces.push_back({group.point, acting.law, acting.area, acting.range, t, t, -1, e, e, o, o});
  }
  // A piece that acts on nothing, or stands for nothing, is none.
  void end() {
    PointPiece& piece = out_.pieces.back();
    piece.triangle_end = static_cast<int>(out_.triangles.size());
    piece.edge_end = static_cast<int>(out_.edges.size());
    piece.other_end = static_cast<int>(out_.others.size());
    const bool empty = piece.triangle_end == piece.triangle_begin && piece.edge_end == piece.edge_begin &&
                       piece.other_end == piece.other_begin;
    if (empty || piece.area == 0) take_back(piece);
  }
  void take_back(const PointPiece& piece) {
    out_.triangles.resize(piece.triangle_begin);
    if (piece.share_begin >= 0) out_.shares.resize(piece.share_begin);
    out_.edges.resize(piece.edge_begin);
    out_.others.resize(piece.other_begin);
    out_.pieces.pop_back();
  }
  static bool has_rods_or_particles(const PointGroup& g) {
    return g.edge_end > g.edge_begin || g.other_end > g.other_begin;
  }

  void add_all(const PointGroup& group, const Acting& acting) {
    begin(group, acting);
    for (int i = group.triangle_begin; i < group.triangle_end; ++i)
      if (reaches(i, acting.range)) out_.triangles.push_back(i);
    for (int i = group.edge_begin; i < group.edge_end; ++i) out_.edges.push_back(rod(i));
    for (int i = group.other_begin; i < group.other_end; ++i) out_.others.push_back(particle(i));
    end();
  }

  void add_piece(const PointGroup& group, const Acting& acting, int piece) {
    begin(group, acting);
    for (const NearTriangle& t : near_)
      if (t.piece == piece && reaches(t.candidate, acting.range)) out_.triangles.push_back(t.candidate);
    end();
  }

  void add_guard(const PointGroup& group, const Guard& guard, double area) {
    if (guard.law < 0) return;
    begin(group, {guard.law, guard.range, area});
    for (int i = group.triangle_begin; i < group.triangle_end; ++i)
      if (reaches(i, guard.range) && !neighbours(group, mesh_.triangles[triangle(i)], guard.range))
        out_.triangles.push_back(i);
    end();
  }

  bool within_object(const PointGroup& group) const { return mesh_.vertex_object[group.point] == group.object; }
  template <size_t K>
  bool neighbours(const PointGroup& group, const std::array<int, K>& vertices, double range) const {
    return within_object(group) && rest_neighbours(r_.surface, std::array{group.point}, vertices, range);
  }

  // Lists the rods and particles of the group that are within range.
  void list_rods(const PointGroup& group, double range) {
    for (int i = group.edge_begin; i < group.edge_end; ++i)
      if (r_.candidates.distance_bounds.point_edge[i] < range && !neighbours(group, mesh_.edges[rod(i)], range))
        out_.edges.push_back(rod(i));
    for (int i = group.other_begin; i < group.other_end; ++i) out_.others.push_back(particle(i));
  }

  // Adds the pieces of rods and particles. They integrate, so that vertices of surfaces carry none
  // of that pressure.
  void add_rods_and_particles(const PointGroup& group, const PairRole& role) {
    const PairRole& thin = r_.pairs.codimensional(mesh_.vertex_object[group.point], group.object, region_pair_);
    const double presses = topology().thin(group.point) ? thin_area(group) : 0;
    if (presses > 0) {
      begin(group, {thin.law, thin.range, presses});
      list_rods(group, thin.range);
      end();
    }
    const Guard guard = guard_of(role);
    const double rest = whole(group.point) - presses;
    if (guard.law < 0 || !(rest > 0)) return;
    begin(group, {guard.law, guard.range, rest});
    list_rods(group, guard.range);
    end();
  }
  // Towards rods and particles [m^2]; between two particles each has half.
  double thin_area(const PointGroup& group) const {
    const double radius = topology().particle_radius(group.point);
    if (radius == 0) return r_.rods.area(group.point, group.object);
    if (group.other_end == group.other_begin) return disc_overlap(radius, r_.surface.rod_width[group.object]);
    const double smaller = std::min(radius, r_.surface.particle_radius[group.object]);
    return M_PI / 2 * smaller * smaller;
  }

  // Returns the weight of a point whose cells have area a, opposite cells of area b: b^4 / (a^4 +
  // b^4). Uniform meshes count the overlap once together, a finer mesh nearly all of it. A coarse
  // point, which may stand for more than the overlap, counts little.
  double share(const PairRole& role, int point, const SeenPiece& piece) const {
    if (!role.by_size) return role.area_factor;
    const double own = r_.held.cell(point, piece.normal), opposite = piece.cell;
    return opposite > 0 ? 1 / (1 + std::pow(own / opposite, 4)) : 0;
  }

  // Returns the pressure area; 0 past the overlap boundary, where the safety barrier alone acts.
  static double pressure_area(const SeenPiece& piece, const PairRole& role, double part) {
    return role.by_size && piece.beyond > rim_slack * std::sqrt(piece.area) ? 0 : part * piece.area;
  }

  // By the triangle that leads a piece.
  const PairRole& role_towards(const PointGroup& group, const SeenPiece& piece) const {
    const int own = mesh_.vertex_object[group.point];
    return r_.pairs.point(own, group.object, r_.pairs.region_pair(own, group.object, std::array{group.point}, mesh_.triangles[piece.triangle]));
  }

  void add_pressure(const PointGroup& group, const PairRole& role) {
    const GroupView* known = views_.find(group.key());
    const FacingView& view = (known ? known : later_views_.find(group.key()))->view;
    const Guard guard = guard_of(role);
    std::array<double, FacingView::most> areas{}, parts{};
    for (int k = 0; k < view.count; ++k) {
      parts[k] = share(role, group.point, view.pieces[k]);
      areas[k] = pressure_area(view.pieces[k], role, parts[k]);
    }
    const Viewpoint from = viewer_.vertex_view(group.point);
    const double reach = std::max(role.range_max(), guard.law >= 0 ? guard.range : 0);
    // A sheet that bends sharply faces its neighbours, nearer than it is thick.
    const bool thick = within_object(group) && r_.pairs.offset(group.object, group.object) > 0;
    near_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      if (!reaches(i, reach)) continue;
      const int piece = thick && neighbours(group, mesh_.triangles[triangle(i)], guard.range) ? -1 : viewer_.piece_of(from, view, triangle(i));
      near_.push_back({i, piece >= 0 && areas[piece] > 0 ? piece : -1});
    }
    for (int k = 0; k < view.count; ++k) {
      const PairRole& here = role_towards(group, view.pieces[k]);
      add_piece(group, {here.law, here.range, areas[k]}, k);
      // The safety barrier acts with the remaining weight, so that points of little pressure do not
      // penetrate.
      const double rest = role.by_size ? (1 - parts[k]) * r_.held.whole(group.point) : 0;
      if (guard.law >= 0 && rest > 0) add_piece(group, {guard.law, guard.range, rest}, k);
    }
    if (guard.law < 0) return;
    begin(group, {guard.law, guard.range, r_.held.whole(group.point)});
    for (const NearTriangle& t : near_)
      if (t.piece < 0 && reaches(t.candidate, guard.range) &&
          !neighbours(group, mesh_.triangles[triangle(t.candidate)], guard.range))
        out_.triangles.push_back(t.candidate);
    end();
  }

  // Adds the pieces of a vertex of a rod, or of a particle. The safety barrier acts towards
  // triangles for which its weight is small.
  void add_thin(const PointGroup& group, const PairRole& role) {
    const PairRole& pressure = r_.pairs.codimensional(mesh_.vertex_object[group.point], group.object, region_pair_);
    const double area = r_.held.thin(group.point);
    triangles_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) triangles_.push_back(triangle(i));
    std::vector<TriangleWeight>& shares = thin_viewer_.look(group.point, triangles_, pressure.range);
    share_out(group.point, pressure.range, shares);
    relax_weights(group.point, triangles_, pressure.range, r_.shares_before, shares, out_.held);
    add_shares(group, {pressure.law, pressure.range, area}, shares, [&](int i, const TriangleWeight& s) {
      return neighbours(group, mesh_.triangles[triangle(i)], pressure.range) ? 0 : s.share;
    });
    const Guard guard = guard_of(role);
    if (guard.law < 0) return;
    add_shares(group, {guard.law, guard.range, area}, shares, [&](int i, const TriangleWeight& s) {
      if (s.share >= little || neighbours(group, mesh_.triangles[triangle(i)], guard.range)) return 0.0;
      const double part = s.share / little;
      return 1 - part * part * (3 - 2 * part);
    });
  }
  // Normalises the weights where a point is close to a surface at several positions of similar
  // direction. A rod of projected width w has room for pi w around it, a particle for four of its
  // cross-sections. Position f has N_f = sum_g m_g max(0, u_f . u_g), with unit vectors u to the
  // point and multiplicities m that fade in the outer half of the range; weights are divided by the
  // mean N_f.
  void share_out(int point, double range, std::vector<TriangleWeight>& shares) {
    const VecX& x = r_.held.x();
    const Vec3 p = vertex(x, point);
    near_triangles_.clear();
    for (const int t : triangles_) near_triangles_.push_back(mesh_.triangles[t]);
    places_.clear();
    for (const PointFeature& f : features_.reduce(x, p, near_triangles_, shares, range)) {
      const Vec3 way = p - closest_on(x, f, p);
      const double fade = std::clamp(2 * (1 - way.norm() / range), 0.0, 1.0);
      places_.emplace_back(f.multiplicity * fade * fade * (3 - 2 * fade), way.normalized());
    }
    double sum = 0, crowd = 0;
    for (const auto& [own, u] : places_) {
      sum += own;
      for (const auto& [other, v] : places_) crowd += own * other * std::max(0.0, u.dot(v));
    }
    if (sum > 0 && crowd > sum)
      for (TriangleWeight& s : shares) s.share *= sum / crowd;
  }
  static Vec3 closest_on(const VecX& x, const PointFeature& f, const Vec3& p) {
    const Vec3 a = vertex(x, f.vertices[0]);
    if (f.count() == 1) return a;
    const Vec3 along = (Vec3(vertex(x, f.vertices[1])) - a).normalized();
    if (f.count() == 2) return a + along.dot(p - a) * along;
    const Vec3 normal = along.cross(Vec3(vertex(x, f.vertices[2])) - a).normalized();
    return p - normal.dot(p - a) * normal;
  }
  template <class Share>
  void add_shares(const PointGroup& group, const Acting& acting, const std::vector<TriangleWeight>& shares, const Share& share) {
    begin(group, acting);
    const int first = static_cast<int>(out_.shares.size());
    out_.pieces.back().share_begin = first;
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      if (!reaches(i, acting.range)) continue;
      TriangleWeight s = shares[i - group.triangle_begin];
      s.share = share(i, s);
      if (!(s.share > 0)) continue;
      out_.triangles.push_back(i);
      out_.shares.push_back(s);
    }
    end();
  }

  const PieceRequest& r_;
  const CollisionMesh& mesh_;
  const EarlierPieces* const earlier_;
  FacingViewer viewer_;
  CodimensionalViewer thin_viewer_;
  SortedCursor<GroupView> views_, later_views_;
  SortedCursor<PointGroup> earlier_groups_;
  PointPieces out_;
  int region_pair_ = -1;                   // of what is nearest of a group, by the laws that hold
  std::vector<NearTriangle> near_;  // of a group
  std::vector<int> triangles_;      // likewise
  std::vector<Triangle> near_triangles_;
  PointFeatures features_;
  std::vector<std::pair<double, Vec3>> places_;  // where a point is near
};

}  // namespace

PointPieces make_pieces(const PieceRequest& request, const EarlierPieces* earlier) {
  const int n = static_cast<int>(request.groups.groups.size());
  std::vector<PointPieces> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    PieceMaker maker(request, earlier);
    for (int g = first; g < last; ++g) maker.add(g);
    chunks[c] = maker.take();
  });
  return joined_pieces(chunks);
}

}  // namespace tack
