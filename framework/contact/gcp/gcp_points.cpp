#include "framework/contact/gcp/gcp_points.hpp"

#include <algorithm>

#include "framework/contact/gcp/gcp_energy.hpp"
#include "geometry/distance/closest_parameters.hpp"

namespace tack {

std::array<double, 4> gcp_coefficients(GcpKind kind, const GcpPositions& x) {
  switch (kind) {
    case GcpKind::vertex_vertex: return {1, -1, 0, 0};
    case GcpKind::vertex_edge: {
      const double u = project_onto_line(x[0], x[1], x[2]).u;
      return {1, u - 1, -u, 0};
    }
    case GcpKind::vertex_face: {
      const PlaneProjection at = project_onto_triangle(x[0], x[1], x[2], x[3]);
      return {1, at.u + at.v - 1, -at.u, -at.v};
    }
    case GcpKind::edge_edge: break;
  }
  const Vec2 at = edge_edge_parameters(x[0], x[1], x[2], x[3], EdgeEdgeType::EA_EB);
  return {1 - at.x(), at.x(), at.y() - 1, -at.y()};
}

ContactPoints gcp_points(const GcpContacts& contacts, const GcpTerm& term, const std::vector<char>& wanted, const VecX& x) {
  const GcpStencils& all = contacts.stencils();
  const std::vector<int>& object = contacts.surface().mesh.vertex_object;
  const std::vector<double> forces = term.normal_forces(x);
  // Points of vertices by vertex, opposite object and law, then pairs of edges.
  std::vector<std::array<int, 5>> order;
  for (size_t i = 0; i < all.stencils.size(); ++i) {
    const GcpStencil& s = all.stencils[i];
    const auto v = all.vertices_of(s);
    if (wanted[s.law]) order.push_back({s.kind == GcpKind::edge_edge, v[0], object[v[gcp_first_count(s.kind)]], s.law, static_cast<int>(i)});
  }
  std::sort(order.begin(), order.end());
  ContactPoints out;
  GcpPositions c;
  for (const auto& key : order) {
    const GcpStencil& s = all.stencils[key[4]];
    const auto v = all.vertices_of(s);
    gcp_positions(x, v, c);
    const std::array<double, 4> w = gcp_coefficients(s.kind, c);
    const int core = gcp_core_count(s.kind), own = gcp_first_count(s.kind);
    Vec3 separation = Vec3::Zero();
    for (int k = 0; k < core; ++k) separation += w[k] * c[k];
    const double gap = separation.norm();
    const Vec3 normal = separation / gap;
    const double area = s.weight * gcp_direction(s, all.factors_of(s), contacts.smoothing(), c);
    with_arity(core, [&]<int K>() {
      if constexpr (K <= 4) {
        ContactPoint<K> p{};
        std::copy_n(v.begin(), K, p.vertices.begin());
        std::copy_n(w.begin(), K, p.coefficients.begin());
        p.normal = normal, p.tangents = tangents_of(normal);
        p.gap = gap, p.area = area, p.normal_force = std::max(forces[key[4]], 0.0);
        p.own_vertex_count = own, p.point = own == 1 ? v[0] : -1;
        p.object = object[v[0]], p.opposite = object[v[own]], p.law = s.law;
        out.of<K>().push_back(p);
      }
    });
  }
  return out;
}

}  // namespace tack
