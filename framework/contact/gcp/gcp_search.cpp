#include "framework/contact/gcp/gcp_search.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <limits>

#include "framework/contact/stencils/chunked_search.hpp"
#include "framework/contact/gcp/gcp_energy.hpp"
#include "framework/contact/gcp/smooth_steps.hpp"
#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/edge_edge.hpp"
#include "geometry/distance/point_triangle.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

// Law between two objects: its range as a gap, and the offset [m].
struct PairContact {
  int law;
  double range, offset;
};

PairContact contact_of(const PairTable& pairs, int a, int b) {
  const int law = pairs.point(a, b).law >= 0 ? pairs.point(a, b).law : pairs.point(b, a).law;
  if (law < 0) return {-1, 0, 0};
  const PairLaw& of_pair = pairs.laws()[law];
  return {law, of_pair.range() - of_pair.offset(), of_pair.offset()};
}

class GcpSearch {
 public:
  GcpSearch(const GcpSearchRequest& request, const Candidates& candidates, const VecX& x, GcpStencils& found)
      : r_(request), mesh_(request.surface.mesh), candidates_(candidates), x_(x), found_(found) {}

  // Searches the candidates of one vertex, first .. last - 1.
  void search_vertex(int first, int last) {
    const int p = candidates_.point_triangle[first][0], own = mesh_.vertex_object[p];
    seen_edges_.clear();
    seen_vertices_.clear();
    for (int i = first; i < last; ++i) {
      const int t = candidates_.point_triangle[i][1];
      const Triangle& corner = mesh_.triangles[t];
      const PairContact contact = contact_of(r_.pairs, own, mesh_.vertex_object[corner[0]]);
      const double reach = contact.range + contact.offset;
      if (contact.law < 0 || candidates_.distance_bounds.point_triangle[i] >= reach) continue;
      const Vec3 at = vertex(x_, p);
      const auto [a, b, c] = corners(x_, corner);
      const PointTriangleType type = point_triangle_type(at, a, b, c);
      if (!(point_triangle_distance(at, a, b, c, type) < reach * reach)) continue;
      if (type == PointTriangleType::P_T) add_vertex_face(p, t, contact);
      for (int k = 0; k < 3; ++k) {
        if (is_new(seen_edges_, r_.rings.edges_of(t)[k])) add_vertex_edge(p, r_.rings.edges_of(t)[k], contact);
        if (p < corner[k] && is_new(seen_vertices_, corner[k])) add_vertex_vertex(p, corner[k], contact);
      }
    }
  }

  void search_edges(int i) {
    const auto [e, f] = candidates_.edge_edge[i];
    const Edge &a = mesh_.edges[e], &b = mesh_.edges[f];
    const PairContact contact = contact_of(r_.pairs, mesh_.vertex_object[a[0]], mesh_.vertex_object[b[0]]);
    const double reach = contact.range + contact.offset;
    if (contact.law < 0 || candidates_.distance_bounds.edge_edge[i] >= reach) return;
    const auto [a0, a1] = corners(x_, a);
    const auto [b0, b1] = corners(x_, b);
    if (edge_edge_type(a0, a1, b0, b1) != EdgeEdgeType::EA_EB) return;
    const double area = std::sqrt(r_.rings.edge_area(e) * r_.rings.edge_area(f));
    begin(GcpKind::edge_edge, {a[0], a[1], b[0], b[1]}, {e, f}, 0.25 * area);
    if (!fits(contact, a, b, std::min(edge_range(e), edge_range(f)))) return;
    const Vec2 at = edge_edge_parameters(a0, a1, b0, b1, EdgeEdgeType::EA_EB);
    const Vec3 to_first = a0 + at.x() * (a1 - a0) - b0 - at.y() * (b1 - b0);
    if (add_edge_factors(0, e, -to_first) && add_edge_factors(1, f, to_first)) finish();
  }

 private:
  static bool is_new(std::vector<int>& seen, int i) {
    if (std::find(seen.begin(), seen.end(), i) != seen.end()) return false;
    seen.push_back(i);
    return true;
  }
  double vertex_range(int v) const { return r_.rest.of_vertex.empty() ? infinity : r_.rest.of_vertex[v]; }
  double edge_range(int e) const { return r_.rest.of_edge.empty() ? infinity : r_.rest.of_edge[e]; }
  double triangle_range(int t) const { return r_.rest.of_triangle.empty() ? infinity : r_.rest.of_triangle[t]; }

  void add_vertex_face(int p, int t, const PairContact& contact) {
    const Triangle& v = mesh_.triangles[t];
    begin(GcpKind::vertex_face, {p, v[0], v[1], v[2]}, {p, t}, 0.25 * r_.rings.vertex_area(p));
    if (!fits(contact, std::array{p}, v, std::min(vertex_range(p), triangle_range(t)))) return;
    const auto [a, b, c] = corners(x_, v);
    const Vec3 normal = (b - a).cross(c - a);
    const bool behind = normal.dot(vertex(x_, p) - a) < 0;
    if (behind && !r_.surface.two_sided[t]) return;
    if (add_vertex_factors(0, p, behind ? normal : Vec3(-normal))) finish();
  }

  void add_vertex_edge(int p, int e, const PairContact& contact) {
    const Edge& v = mesh_.edges[e];
    const Vec3 at = vertex(x_, p);
    const auto [a, b] = corners(x_, v);
    if (point_edge_type(at, a, b) != PointEdgeType::P_E) return;
    begin(GcpKind::vertex_edge, {p, v[0], v[1], -1}, {p, e}, 0.25 * r_.rings.vertex_area(p));
    if (!fits(contact, std::array{p}, v, std::min(vertex_range(p), edge_range(e)))) return;
    const Vec3 to_vertex = project_onto_line(at, a, b).residual;
    if (add_vertex_factors(0, p, -to_vertex) && add_edge_factors(1, e, to_vertex)) finish();
  }

  void add_vertex_vertex(int p, int q, const PairContact& contact) {
    begin(GcpKind::vertex_vertex, {p, q, -1, -1}, {p, q}, 0.25 * (r_.rings.vertex_area(p) + r_.rings.vertex_area(q)));
    if (!fits(contact, std::array{p}, std::array{q}, std::min(vertex_range(p), vertex_range(q)))) return;
    const Vec3 to_first = vertex(x_, p) - vertex(x_, q);
    if (add_vertex_factors(0, p, -to_first) && add_vertex_factors(1, q, to_first)) finish();
  }

  void begin(GcpKind kind, const std::array<int, 4>& core, const std::array<int, 2>& primitives, double weight) {
    now_ = {kind, 0, -1, weight, 0, 1, primitives, 0, 0, 0};
    vertices_.assign(core.begin(), core.begin() + gcp_core_count(kind));
    factors_.clear();
  }

  // Sets the law of the stencil. Returns whether the primitives a and b are within its range. rest_range:
  // of a pair of one object [m].
  template <size_t A, size_t B>
  bool fits(const PairContact& contact, const std::array<int, A>& a, const std::array<int, B>& b, double rest_range) {
    const bool self = mesh_.vertex_object[a[0]] == mesh_.vertex_object[b[0]];
    now_.law = contact.law;
    now_.offset = self && contact.offset > 0 ? offset_between(r_.surface, r_.pairs, a, b) : contact.offset;
    now_.shortening = self ? std::max(1.0, contact.range / rest_range) : 1;
    std::array<Vec3, gcp_arity_max> x;
    gcp_positions(x_, vertices_, x);
    return gcp_distance(now_.kind, x) - now_.offset < contact.range / now_.shortening &&
           gcp_mollifier(now_.kind, r_.smoothing, x) > 0;
  }

  unsigned char local(int v) {
    const auto found = std::find(vertices_.begin(), vertices_.end(), v);
    if (found != vertices_.end()) return static_cast<unsigned char>(found - vertices_.begin());
    vertices_.push_back(v);
    return static_cast<unsigned char>(vertices_.size() - 1);
  }

  // Adds the local-minimum factor of a tangent. Returns false if it is 0. direction: to the other primitive.
  bool add_tangent(int primitive, const Vec3& direction, const Vec3& tangent, int v) {
    const double y = -direction.dot(tangent) / std::sqrt(direction.squaredNorm() * tangent.squaredNorm());
    if (!(y > -r_.smoothing.alpha_t)) return false;
    if (y < r_.smoothing.beta_t) factors_.push_back({GcpFactor::Type::tangent, static_cast<unsigned char>(primitive), local(v), 0});
    return true;
  }

  // An exterior factor: its cosine u . n, and the vertices that become a and b; b < 0: `flag` is b.
  struct Exterior {
    double cosine;
    int a, b;
    unsigned char flag;
  };
  // Adds the exterior factors of a primitive. Returns false if their sum is 0.
  bool add_exteriors(int primitive) {
    double sum = 0;
    for (const Exterior& e : exteriors_) sum += smooth_heaviside(e.cosine, r_.smoothing.alpha_n, r_.smoothing.beta_n).value;
    if (sum >= 1) return true;
    for (const Exterior& e : exteriors_)
      if (e.cosine > -r_.smoothing.alpha_n)
        factors_.push_back({GcpFactor::Type::exterior, static_cast<unsigned char>(primitive), local(e.a), e.b < 0 ? e.flag : local(e.b)});
    return sum > 0;
  }

  bool add_vertex_factors(int primitive, int v, const Vec3& direction) {
    const Vec3 at = vertex(x_, v);
    for (const int n : r_.rings.neighbours(v))
      if (!add_tangent(primitive, direction, vertex(x_, n) - at, n)) return false;
    if (r_.rings.two_sided(v)) return true;
    exteriors_.clear();
    for (const auto& [a, b] : r_.rings.fan(v)) {
      const Vec3 n = (vertex(x_, a) - at).cross(vertex(x_, b) - at);
      exteriors_.push_back({direction.dot(n) / std::sqrt(direction.squaredNorm() * n.squaredNorm()), a, b, 0});
    }
    return add_exteriors(primitive);
  }

  bool add_edge_factors(int primitive, int e, const Vec3& direction) {
    const auto [e0, e1] = corners(x_, mesh_.edges[e]);
    const Vec3 along = e1 - e0;
    for (const OppositeVertex& o : r_.rings.opposite(e)) {
      const Vec3 q = vertex(x_, o.vertex) - e0;
      if (!add_tangent(primitive, direction, q - q.dot(along) / along.squaredNorm() * along, o.vertex)) return false;
    }
    if (r_.rings.two_sided(mesh_.edges[e][0]) || r_.rings.two_sided(mesh_.edges[e][1])) return true;
    exteriors_.clear();
    for (const OppositeVertex& o : r_.rings.opposite(e)) {
      const Vec3 n = o.orientation * along.cross(vertex(x_, o.vertex) - e0);
      exteriors_.push_back({direction.dot(n) / std::sqrt(direction.squaredNorm() * n.squaredNorm()), o.vertex, -1,
                            static_cast<unsigned char>(o.orientation > 0)});
    }
    return add_exteriors(primitive);
  }

  void finish() {
    if (!r_.free.empty() && std::none_of(vertices_.begin(), vertices_.end(), [&](int v) { return r_.free[v] != 0; })) return;
    now_.arity = static_cast<unsigned char>(vertices_.size());
    now_.vertex_begin = static_cast<int>(found_.vertices.size());
    now_.factor_begin = static_cast<int>(found_.factors.size());
    found_.vertices.insert(found_.vertices.end(), vertices_.begin(), vertices_.end());
    found_.factors.insert(found_.factors.end(), factors_.begin(), factors_.end());
    now_.factor_end = static_cast<int>(found_.factors.size());
    found_.stencils.push_back(now_);
  }

  const GcpSearchRequest& r_;
  const CollisionMesh& mesh_;
  const Candidates& candidates_;
  const VecX& x_;
  GcpStencils& found_;
  GcpStencil now_{};
  std::vector<int> vertices_, seen_edges_, seen_vertices_;
  std::vector<GcpFactor> factors_;
  std::vector<Exterior> exteriors_;
};

// Joins the stencils of all chunks by ascending arity, in the order of the chunks.
GcpStencils by_arity(const std::vector<GcpStencils>& chunks) {
  GcpStencils all;
  size_t stencils = 0, vertices = 0, factors = 0;
  int largest = 0;
  for (const GcpStencils& chunk : chunks) {
    stencils += chunk.stencils.size(), vertices += chunk.vertices.size(), factors += chunk.factors.size();
    for (const GcpStencil& s : chunk.stencils) largest = std::max<int>(largest, s.arity);
  }
  all.stencils.reserve(stencils), all.vertices.reserve(vertices), all.factors.reserve(factors);
  for (int arity = 2; arity <= largest; ++arity)
    for (const GcpStencils& chunk : chunks)
      for (const GcpStencil& s : chunk.stencils) {
        if (s.arity != arity) continue;
        GcpStencil& copy = all.stencils.emplace_back(s);
        copy.vertex_begin = static_cast<int>(all.vertices.size());
        copy.factor_begin = static_cast<int>(all.factors.size());
        const auto v = chunk.vertices_of(s);
        const auto f = chunk.factors_of(s);
        all.vertices.insert(all.vertices.end(), v.begin(), v.end());
        all.factors.insert(all.factors.end(), f.begin(), f.end());
        copy.factor_end = static_cast<int>(all.factors.size());
      }
  return all;
}

}  // namespace

void gcp_positions(const VecX& x, std::span<const int> vertices, std::array<Vec3, gcp_arity_max>& out) {
  for (size_t i = 0; i < vertices.size(); ++i) out[i] = vertex(x, vertices[i]);
}

GcpStencils find_gcp_stencils(const GcpSearchRequest& request, const Candidates& candidates, const VecX& x) {
  const std::vector<GcpStencils> found =
      search_in_chunks<GcpStencils>(candidates, [&](GcpStencils& chunk) { return GcpSearch(request, candidates, x, chunk); });
  return by_arity(found);
}

GcpRestRanges gcp_rest_ranges(const ContactSurface& surface, const SurfaceRings& rings, const PairTable& pairs, const GcpSmoothing& smoothing) {
  const CollisionMesh& mesh = surface.mesh;
  GcpRestRanges none, ranges;
  CollidingObjects colliding(pairs.classes());
  double range = 0;
  for (const auto& [a, b] : pairs.classes().examples()) {
    const PairContact contact = contact_of(pairs, a, b);
    if (a == b && contact.law >= 0) range = std::max(range, contact.range + contact.offset);
  }
  ranges.of_vertex.assign(mesh.vertex_object.size(), infinity);
  ranges.of_edge.assign(mesh.edges.size(), infinity);
  ranges.of_triangle.assign(mesh.triangles.size(), infinity);
  if (range == 0) return ranges;
  BroadPhase broad_phase(mesh, colliding);
  broad_phase.update(surface.rest, VecX(), range, 0);
  const std::vector<char> every;
  const GcpStencils found = find_gcp_stencils({surface, rings, pairs, smoothing, none, every}, broad_phase.candidates(), surface.rest);
  GcpPositions x;
  for (const GcpStencil& s : found.stencils) {
    const auto v = found.vertices_of(s);
    const int first = gcp_first_count(s.kind);
    if (mesh.vertex_object[v[0]] != mesh.vertex_object[v[first]]) continue;
    gcp_positions(surface.rest, v, x);
    const double half = 0.5 * (gcp_distance(s.kind, x) - s.offset);
    const auto lower = [&](std::vector<double>& list, int i) { list[i] = std::min(list[i], half); };
    lower(s.kind == GcpKind::edge_edge ? ranges.of_edge : ranges.of_vertex, s.primitives[0]);
    lower(s.kind == GcpKind::vertex_vertex ? ranges.of_vertex : s.kind == GcpKind::vertex_face ? ranges.of_triangle : ranges.of_edge, s.primitives[1]);
  }
  for (size_t e = 0; e < mesh.edges.size(); ++e)
    for (const int v : mesh.edges[e]) ranges.of_edge[e] = std::min(ranges.of_edge[e], ranges.of_vertex[v]);
  for (size_t t = 0; t < mesh.triangles.size(); ++t)
    for (int k = 0; k < 3; ++k)
      ranges.of_triangle[t] = std::min({ranges.of_triangle[t], ranges.of_vertex[mesh.triangles[t][k]], ranges.of_edge[rings.edges_of(static_cast<int>(t))[k]]});
  return ranges;
}

}  // namespace tack
