#include "framework/contact/point_pieces.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "geometry/distance/box_gap.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Makes the pieces of one chunk of groups.
class PieceMaker {
 public:
  explicit PieceMaker(const PieceRequest& r) : r_(r), mesh_(r.surface.mesh), viewer_(mesh_, r.held) {}

  void add(int g) {
    const PointGroup& group = r_.groups.groups[g];
    const PairRole& role = r_.pairs.point(mesh_.vertex_object[group.point], group.object);
    if (role.law < 0) return;
    if (r_.pairs.plain_sums) {
      add_all(g, {role.law, role.range, role.share * r_.held.whole(group.point)}, false);
    } else if (r_.sides.integrates(mesh_.vertex_object[group.point], group.object)) {
      add_pressure(g, role);
    } else if (role.facing) {
      add_guard(g, role.guard_law, role.guard_range);
    } else {
      add_guard(g, role.law, role.range);
    }
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

  int triangle(int i) const { return r_.candidates.point_triangle[i][1]; }
  // Whether the pair may come within a range [m] while the candidates hold.
  bool reaches(int i, double range) const { return r_.candidates.clearances.point_triangle[i] < range; }

  void begin(int g, const Acting& acting, bool with_codim) {
    out_.pieces.push_back({r_.groups.groups[g].point, acting.law, acting.area, acting.range,
                           static_cast<int>(out_.triangles.size()), 0, with_codim ? g : -1});
  }
  // A piece that acts on nothing is none.
  void end() {
    PointPiece& piece = out_.pieces.back();
    piece.triangle_end = static_cast<int>(out_.triangles.size());
    const bool codim = piece.group >= 0 && has_codim(r_.groups.groups[piece.group]);
    if (piece.triangle_end == piece.triangle_begin && !codim) out_.pieces.pop_back();
  }
  static bool has_codim(const PointGroup& g) { return g.edge_end > g.edge_begin || g.other_end > g.other_begin; }

  void add_all(int g, const Acting& acting, bool without_rest_neighbours) {
    const PointGroup& group = r_.groups.groups[g];
    begin(g, acting, true);
    for (int i = group.triangle_begin; i < group.triangle_end; ++i)
      if (reaches(i, acting.range) &&
          (!without_rest_neighbours || !rest_neighbour(group, triangle(i), acting.range)))
        out_.triangles.push_back(triangle(i));
    end();
  }

  void add_piece(int g, const Acting& acting, int piece) {
    begin(g, acting, false);
    for (const NearTriangle& t : near_)
      if (t.piece == piece && reaches(t.candidate, acting.range)) out_.triangles.push_back(triangle(t.candidate));
    end();
  }

  void add_guard(int g, int law, double range) {
    if (law < 0) return;
    add_all(g, {law, range, r_.held.whole(r_.groups.groups[g].point)}, true);
  }

  // What already is closer at rest does not press: a body alone is without stress.
  bool rest_neighbour(const PointGroup& group, int t, double range) const {
    if (mesh_.vertex_object[group.point] != group.object) return false;
    const Vec3 p = vertex(r_.surface.rest, group.point);
    const auto v = corners(r_.surface.rest, mesh_.triangles[t]);
    return box_gaps(std::array{p}, v).maxCoeff() < range && point_triangle_distance(p, v[0], v[1], v[2]) < range * range;
  }

  // Of a point whose cells have area a, opposite cells of area b: b^4 / (a^4 + b^4). Uniform meshes count the overlap
  // once together, the finer one nearly all of it; a coarse point, which may stand for more than the overlap, little.
  double share(const PairRole& role, int point, const SeenPiece& piece) const {
    if (!role.by_size) return role.share;
    const double own = r_.held.cell(point, piece.normal), opposite = piece.cell;
    return opposite > 0 ? 1 / (1 + std::pow(own / opposite, 4)) : 0;
  }

  // What the point covers nothing of, or lies beyond the rim of, is only guarded against.
  static int pressing(const FacingView& view, int piece, const PairRole& role) {
    if (piece < 0 || !(view.pieces[piece].area > 0)) return -1;
    const bool beside = role.by_size && view.pieces[piece].beyond > rim_slack * std::sqrt(view.pieces[piece].area);
    return beside ? -1 : piece;
  }

  void add_pressure(int g, const PairRole& role) {
    const PointGroup& group = r_.groups.groups[g];
    const auto known = std::lower_bound(r_.views.begin(), r_.views.end(), group.key(),
                                        [](const GroupView& v, const std::array<int, 2>& key) { return v.key() < key; });
    const Viewpoint from = viewer_.vertex_view(group.point);
    const double reach = std::max(role.range, role.guard_law >= 0 ? role.guard_range : 0);
    near_.clear();
    for (int i = group.triangle_begin; i < group.triangle_end; ++i)
      if (reaches(i, reach))
        near_.push_back({i, pressing(known->view, viewer_.piece_of(from, known->view, triangle(i)), role)});
    for (int k = 0; k < known->view.count; ++k) {
      const double part = share(role, group.point, known->view.pieces[k]);
      add_piece(g, {role.law, role.range, part * known->view.pieces[k].area}, k);
      // What presses little must not come through, either.
      if (role.by_size && role.guard_law >= 0)
        add_piece(g, {role.guard_law, role.guard_range, (1 - part) * r_.held.whole(group.point)}, k);
    }
    if (has_codim(group)) {
      begin(g, {role.law, role.range, role.share * r_.held.whole(group.point)}, true);
      end();
    }
    if (role.guard_law < 0) return;
    begin(g, {role.guard_law, role.guard_range, r_.held.whole(group.point)}, false);
    for (const NearTriangle& t : near_)
      if (t.piece < 0 && reaches(t.candidate, role.guard_range) &&
          !rest_neighbour(group, triangle(t.candidate), role.guard_range))
        out_.triangles.push_back(triangle(t.candidate));
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
    const int offset = static_cast<int>(all.triangles.size());
    for (PointPiece p : chunk.pieces) {
      p.triangle_begin += offset;
      p.triangle_end += offset;
      all.pieces.push_back(p);
    }
    all.triangles.insert(all.triangles.end(), chunk.triangles.begin(), chunk.triangles.end());
  }
  return all;
}

}  // namespace tack
