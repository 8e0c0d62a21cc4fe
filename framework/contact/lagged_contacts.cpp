#include "framework/contact/lagged_contacts.hpp"

#include <Eigen/Geometry>

#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"

namespace tack {
namespace {

LaggedContact<4> edge_contact(const VecX& x, const ContactStencil<4>& s, double eps_x,
                              const PairLaw& barrier) {
  const auto& v = s.vertices;
  const Vec3 a0 = vertex(x, v[0]), a1 = vertex(x, v[1]), b0 = vertex(x, v[2]), b1 = vertex(x, v[3]);
  const Vec2 at = edge_edge_parameters(a0, a1, b0, b1);
  LaggedContact<4> c{v, {1 - at.x(), at.x(), at.y() - 1, -at.y()}, {}, s.law, 2, 0, 0};
  const auto& k = c.coefficients;
  const Vec3 separation = k[0] * a0 + k[1] * a1 + k[2] * b0 + k[3] * b1;
  const double gap = separation.norm();
  const double weight = s.weight * edge_edge_mollifier(a0, a1, b0, b1, eps_x);
  c.tangents = tangents_of(separation / gap);
  c.normal_force = -weight * barrier.at(gap).slope;
  c.area = weight;
  return c;
}

}  // namespace

TangentBasis tangents_of(const Vec3& normal) {
  TangentBasis basis;
  basis.col(0) = normal.unitOrthogonal();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

LaggedContacts lag_contacts(const LagRequest& request) {
  LaggedContacts out;
  lag_points(request, out);
  const ContactSet& set = request.system.contacts();
  for (size_t i = 0; i < set.edge_edge.size(); ++i) {
    const ContactStencil<4>& s = set.edge_edge[i];
    if (!request.wanted[s.law]) continue;
    const PairLaw& barrier = request.barriers[s.law];
    out.fours.push_back(edge_contact(request.x, s, set.mollifier_threshold[i], barrier));
  }
  return out;
}

}  // namespace tack
