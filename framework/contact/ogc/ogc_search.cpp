#include "framework/contact/ogc/ogc_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>

#include "framework/contact/stencils/chunked_search.hpp"
#include "framework/contact/ogc/feasible_cones.hpp"
#include "framework/contact/stencils/rest_neighbours.hpp"
#include "framework/contact/stencils/stencil_search.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

class OgcSearch {
 public:
  OgcSearch(const OgcSearchRequest& request, const Candidates& candidates, const VecX& x, ContactSet& found)
      : r_(request), mesh_(request.surface.mesh), candidates_(candidates), x_(x), found_(found) {}

  // Searches the candidates of one vertex, first .. last - 1.
  void search_vertex(int first, int last) {
    const int p = candidates_.point_triangle[first][0], own = mesh_.vertex_object[p];
    const Vec3 at = vertex(x_, p);
    hits_.clear();
    for (int i = first; i < last; ++i) {
      const int t = candidates_.point_triangle[i][1];
      const Triangle& v = mesh_.triangles[t];
      const int other = mesh_.vertex_object[v[0]];
      const PairRole& role = r_.pairs.point(own, other);
      if (role.law < 0 || candidates_.distance_bounds.point_triangle[i] >= role.range) continue;
      const bool self = own == other && r_.surface.rest_gaps;
      const int law = self ? r_.surface.rest_gaps->law_of_point(role.law, p) : role.law;
      const double range = law == role.law ? role.range : r_.surface.rest_gaps->range(law);
      const auto [a, b, c] = corners(x_, v);
      const PointTriangleType type = point_triangle_type(at, a, b, c);
      if (!(point_triangle_distance(at, a, b, c, type) < range * range)) continue;
      if (self && rest_neighbours(r_.surface, std::array{p}, v, role.range)) continue;
      hits_.push_back({t, type, law});
    }
    // Faces first, then edges, then vertices: rounding errors put no point into a block and also into
    // one at its boundary.
    taken_edges_.clear();
    taken_vertices_.clear();
    using enum PointTriangleType;
    const double weight = 0.25 * r_.rings.vertex_area(p);
    const std::array<size_t, 3> before{found_.point_point.size(), found_.point_edge.size(), found_.point_triangle.size()};
    for (const Hit& h : hits_)
      if (h.type == P_T) add_face(p, h, weight);
    for (const Hit& h : hits_)
      if (h.type == P_E0 || h.type == P_E1 || h.type == P_E2) add_edge(p, r_.rings.edges_of(h.triangle)[static_cast<int>(h.type) - static_cast<int>(P_E0)], h.law, weight);
    for (const Hit& h : hits_)
      if (h.type == P_T0 || h.type == P_T1 || h.type == P_T2) add_vertex(p, mesh_.triangles[h.triangle][static_cast<int>(h.type) - static_cast<int>(P_T0)], h.law, weight);
    number_points(before);
  }

  void search_edges(int i) {
    const auto [e, f] = candidates_.edge_edge[i];
    const Edge &a = mesh_.edges[e], &b = mesh_.edges[f];
    const int own = mesh_.vertex_object[a[0]], other = mesh_.vertex_object[b[0]];
    const PairRole& role = r_.pairs.edge(own, other);
    if (role.law < 0 || candidates_.distance_bounds.edge_edge[i] >= role.range) return;
    const bool self = own == other && r_.surface.rest_gaps;
    const int law = self ? r_.surface.rest_gaps->law_of_edges(role.law, a, b) : role.law;
    const double range = law == role.law ? role.range : r_.surface.rest_gaps->range(law);
    const auto [a0, a1] = corners(x_, a);
    const auto [b0, b1] = corners(x_, b);
    if (edge_edge_type(a0, a1, b0, b1) != EdgeEdgeType::EA_EB) return;
    const Vec3 to_first = project_line_onto_line(a0, a1, b0, b1).residual;
    if (!(to_first.squaredNorm() < range * range)) return;
    if (!outside_edge(r_.rings, mesh_, x_, e, -to_first) || !outside_edge(r_.rings, mesh_, x_, f, to_first)) return;
    if (self && rest_neighbours(r_.surface, a, b, role.range)) return;
    add(found_.edge_edge, {{a[0], a[1], b[0], b[1]}, law, -1, 0.25 * std::sqrt(r_.rings.edge_area(e) * r_.rings.edge_area(f))});
  }

 private:
  // A triangle within range of the vertex.
  struct Hit {
    int triangle;
    PointTriangleType type;
    int law;
  };

  // Numbers the contact points of a vertex by object and law. before: the numbers of stencils before.
  void number_points(const std::array<size_t, 3>& before) {
    keys_.clear();
    const auto for_each_new = [&](const auto& act) {
      std::for_each(found_.point_point.begin() + static_cast<std::ptrdiff_t>(before[0]), found_.point_point.end(), act);
      std::for_each(found_.point_edge.begin() + static_cast<std::ptrdiff_t>(before[1]), found_.point_edge.end(), act);
      std::for_each(found_.point_triangle.begin() + static_cast<std::ptrdiff_t>(before[2]), found_.point_triangle.end(), act);
    };
    const auto key_of = [&](const auto& s) { return std::pair(mesh_.vertex_object[s.vertices[1]], s.law); };
    for_each_new([&](const auto& s) { keys_.push_back(key_of(s)); });
    std::sort(keys_.begin(), keys_.end());
    keys_.erase(std::unique(keys_.begin(), keys_.end()), keys_.end());
    for_each_new([&](auto& s) { s.point = found_.point_count + static_cast<int>(std::lower_bound(keys_.begin(), keys_.end(), key_of(s)) - keys_.begin()); });
    found_.point_count += static_cast<int>(keys_.size());
  }

  void add_face(int p, const Hit& h, double weight) {
    const Triangle& v = mesh_.triangles[h.triangle];
    const auto [a, b, c] = corners(x_, v);
    if (!r_.surface.two_sided[h.triangle] && (b - a).cross(c - a).dot(vertex(x_, p) - a) < 0) return;
    taken_edges_.insert(taken_edges_.end(), r_.rings.edges_of(h.triangle).begin(), r_.rings.edges_of(h.triangle).end());
    taken_vertices_.insert(taken_vertices_.end(), v.begin(), v.end());
    add(found_.point_triangle, {{p, v[0], v[1], v[2]}, h.law, -1, weight});
  }

  void add_edge(int p, int e, int law, double weight) {
    if (!take(taken_edges_, e)) return;
    const Edge& v = mesh_.edges[e];
    const auto [a, b] = corners(x_, v);
    if (!in_edge_cone(r_.rings, mesh_, x_, e, project_onto_line(vertex(x_, p), a, b).residual)) return;
    taken_vertices_.insert(taken_vertices_.end(), v.begin(), v.end());
    add(found_.point_edge, {{p, v[0], v[1]}, law, -1, weight});
  }

  void add_vertex(int p, int q, int law, double weight) {
    if (!take(taken_vertices_, q)) return;
    const Vec3 d = vertex(x_, p) - vertex(x_, q);
    if (in_vertex_cone(r_.rings, x_, q, d) && in_vertex_cone(r_.rings, x_, p, -d)) add(found_.point_point, {{p, q}, law, -1, weight});
  }

  static bool take(std::vector<int>& taken, int i) {
    if (std::find(taken.begin(), taken.end(), i) != taken.end()) return false;
    taken.push_back(i);
    return true;
  }

  template <int K>
  void add(ContactStencils<K>& list, const ContactStencil<K>& s) {
    if (any_of(r_.free, s.vertices)) list.push_back(s);
  }

  const OgcSearchRequest& r_;
  const CollisionMesh& mesh_;
  const Candidates& candidates_;
  const VecX& x_;
  ContactSet& found_;
  std::vector<Hit> hits_;
  std::vector<std::pair<int, int>> keys_;  // object and law of each contact point of a vertex
  std::vector<int> taken_edges_, taken_vertices_;  // of blocks that are found, or adjacent to them
};

}  // namespace

void find_ogc_contacts(const OgcSearchRequest& request, const Candidates& candidates, const VecX& x, ContactSet& contacts) {
  join(search_in_chunks<FoundStencils>(candidates, [&](FoundStencils& chunk) { return OgcSearch(request, candidates, x, chunk); }), request.surface.rest, contacts);
}

}  // namespace tack
