#include "framework/contact/point_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "framework/contact/rest_neighbours.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Makes the pieces of one chunk of groups.
class PieceMaker {
 public:
  explicit PieceMaker(const PieceRequest& r) : r_(r), mesh_(r.surface.mesh), viewer_(mesh_, r.held) {}

  void add(int g) {
    const PointGroup& group = r_.groups.groups[g];
    const int own = mesh_.vertex_object[group.point];
    const PairRole& role = r_.pairs.point(own, group.object);
    if (role.law < 0) return;
    if (r_.pairs.plain_sums) {
      add_all(group, {role.law, role.range, role.share * whole(group.point)});
      return;
    }
    const bool integrates = r_.sides.integrates(own, group.object), thin = topology().thin(group.point);
    if (integrates || thin) add_pressure(group, role, integrates);
    else add_guard(group, guard_of(role), whole(group.point));
    if (has_rods_or_particles(group)) add_rods_and_particles(group, role);
  }
  PointPieces take() { return std::move(out_); }

 private:
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

  const SurfaceTopology& topology() const { return r_.held.topology(); }
  double whole(int point) const {
    return r_.held.whole(point) + (topology().thin(point) ? r_.held.thin(point) : 0);
  }
  // Of a side that presses, or of one that only guards.
  static Guard guard_of(const PairRole& role) {
    if (role.facing) return {role.guard_law, role.guard_range};
    return {role.law, role.range};
  }
  int triangle(int i) const { return r_.candidates.point_triangle[i][1]; }
  int rod(int i) const { return r_.candidates.point_edge[i][1]; }
  int particle(int i) const { return r_.groups.particles[i][1]; }
  // Whether the pair may come within a range [m] while the candidates hold.
  bool reaches(int i, double range) const { return r_.candidates.clearances.point_triangle[i] < range; }

  void begin(const PointGroup& group, const Acting& acting) {
    const auto end = [](const std::vector<int>& list) { return static_cast<int>(list.size()); };
    const int t = end(out_.triangles), e = end(out_.edges), o = end(out_.others);
    out_.pieces.push_back({group.point, acting.law, acting.area, acting.range, t, t, e, e, o, o});
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
      if (reaches(i, guard.range) && !at_rest(group, mesh_.triangles[triangle(i)], guard.range))
        out_.triangles.push_back(i);
    end();
  }

  template <size_t K>
  bool at_rest(const PointGroup& group, const std::array<int, K>& vertices, double range) const {
    return mesh_.vertex_object[group.point] == group.object &&
           rest_neighbours(r_.surface, std::array{group.point}, vertices, range);
  }

  // Of the rods and particles of the group, those that are within reach.
  void list_rods(const PointGroup& group, double range) {
    for (int i = group.edge_begin; i < group.edge_end; ++i)
      if (r_.candidates.clearances.point_edge[i] < range && !at_rest(group, mesh_.edges[rod(i)], range))
        out_.edges.push_back(rod(i));
    for (int i = group.other_begin; i < group.other_end; ++i) out_.others.push_back(particle(i));
  }

  // What a vertex of a surface has no part in: the rod or particle integrates.
  void add_rods_and_particles(const PointGroup& group, const PairRole& role) {
    const PairRole& thin = r_.pairs.thin(mesh_.vertex_object[group.point], group.object);
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

  // Of a point whose cells have area a, opposite cells of area b: b^4 / (a^4 + b^4). Uniform meshes count the overlap
  // once together, the finer one nearly all of it; a coarse point, which may stand for more than the overlap, little.
  double share(const PairRole& role, int point, const SeenPiece& piece) const {
    if (!role.by_size) return role.share;
    const double own = r_.held.cell(point, piece.normal), opposite = piece.cell;
    return opposite > 0 ? 1 / (1 + std::pow(own / opposite, 4)) : 0;
  }

  // What the point covers nothing of, or lies beyond the rim of, is only guarded against. Rods and particles have no
  // area of their own beyond a rim.
  static double pressure_area(const SeenPiece& piece, const PairRole& role, bool integrates, double part) {
    const double area = integrates ? piece.area : 0;
    const double slack = rim_slack * std::sqrt(area + piece.thin);
    const double thin = piece.beyond > slack ? 0 : piece.thin;
    return (role.by_size && piece.beyond > slack ? 0 : part * area) + thin;
  }

  // integrates: the side of the pair; else only what the point is of rods and particles.
  void add_pressure(const PointGroup& group, const PairRole& role, bool integrates) {
    const auto known = std::lower_bound(r_.views.begin(), r_.views.end(), group.key(),
                                        [](const GroupView& v, const std::array<int, 2>& key) { return v.key() < key; });
    const FacingView& view = known->view;
    const PairRole& pressure = integrates ? role : r_.pairs.thin(mesh_.vertex_object[group.point], group.object);
    const Guard guard = guard_of(role);
    std::array<double, FacingView::most> areas{}, parts{};
    for (int k = 0; k < view.count; ++k) {
      parts[k] = share(role, group.point, view.pieces[k]);
      areas[k] = pressure_area(view.pieces[k], role, integrates, parts[k]);
    }
    const Viewpoint from = viewer_.vertex_view(group.point);
    const double reach = std::max(pressure.range, guard.law >= 0 ? guard.range : 0);
    near_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i) {
      if (!reaches(i, reach)) continue;
      const int piece = viewer_.piece_of(from, view, triangle(i));
      near_.push_back({i, piece >= 0 && areas[piece] > 0 ? piece : -1});
    }
    for (int k = 0; k < view.count; ++k) {
      add_piece(group, {pressure.law, pressure.range, areas[k]}, k);
      // What presses little must not come through, either.
      const double rest = integrates ? (role.by_size ? (1 - parts[k]) * r_.held.whole(group.point) : 0) : r_.held.whole(group.point);
      if (guard.law >= 0 && rest > 0) add_piece(group, {guard.law, guard.range, rest}, k);
    }
    if (guard.law < 0) return;
    begin(group, {guard.law, guard.range, whole(group.point)});
    for (const NearTriangle& t : near_)
      if (t.piece < 0 && reaches(t.candidate, guard.range) &&
          !at_rest(group, mesh_.triangles[triangle(t.candidate)], guard.range))
        out_.triangles.push_back(t.candidate);
    end();
  }

  const PieceRequest& r_;
  const CollisionMesh& mesh_;
  FacingViewer viewer_;
  PointPieces out_;
  std::vector<NearTriangle> near_;  // of a group
};

}  // namespace

PointPieces make_pieces(const PieceRequest& request) {
  const int n = static_cast<int>(request.groups.groups.size());
  std::vector<PointPieces> chunks(chunk_count(n));
  for_each_chunk(n, [&](int c, int first, int last) {
    PieceMaker maker(request);
    for (int g = first; g < last; ++g) maker.add(g);
    chunks[c] = maker.take();
  });
  PointPieces all;
  for (PointPieces& chunk : chunks) {
    const auto append = [](const std::vector<int>& list, std::vector<int>& to) {
      to.insert(to.end(), list.begin(), list.end());
    };
    const auto shift = [](const std::vector<int>& before, int& begin, int& end) {
      begin += static_cast<int>(before.size());
      end += static_cast<int>(before.size());
    };
    for (PointPiece p : chunk.pieces) {
      shift(all.triangles, p.triangle_begin, p.triangle_end);
      shift(all.edges, p.edge_begin, p.edge_end);
      shift(all.others, p.other_begin, p.other_end);
      all.pieces.push_back(p);
    }
    append(chunk.triangles, all.triangles);
    append(chunk.edges, all.edges);
    append(chunk.others, all.others);
  }
  return all;
}

}  // namespace tack
