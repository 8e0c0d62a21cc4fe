#include "framework/contact/points/contact_points.hpp"

#include <Eigen/Geometry>

#include "framework/contact/contact_potential.hpp"
#include "framework/contact/contact_system.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/distance/edge_edge_mollifier.hpp"

namespace tack {
namespace {

ContactPoint<4> edge_point(const ContactPointsRequest& request, const ContactStencil<4>& s, double eps_x) {
  const auto& v = s.vertices;
  const auto& object = request.system.surface().mesh.vertex_object;
  const auto [a0, a1, b0, b1] = corners(request.x, v);
  const Vec2 at = edge_edge_parameters(a0, a1, b0, b1);
  const std::array<double, 4> c{1 - at.x(), at.x(), at.y() - 1, -at.y()};
  const Vec3 separation = c[0] * a0 + c[1] * a1 + c[2] * b0 + c[3] * b1;
  const double gap = separation.norm();
  const Vec3 normal = separation / gap;
  const double area = s.weight * edge_edge_mollifier(a0, a1, b0, b1, eps_x);
  const double force = -area * request.system.pairs().laws(LawTerm::barrier)[s.law].at(gap).slope;
  return {v, c, normal, tangents_of(normal), gap, area, force, 2, -1, object[v[0]], object[v[2]], s.law};
}

void add_integrated_laws(const PairTable& pairs, int a, int b, std::vector<char>& laws) {
  for (int region_pair = -1; region_pair < pairs.region_pair_count(a, b); ++region_pair) {
    for (const PairRole* role : {&pairs.point(a, b, region_pair), &pairs.point(b, a, region_pair)})
      if (role->law >= 0 && role->counts_area) laws[role->law] = 1;
    if (const int codimensional = pairs.codimensional(a, b, region_pair).law; codimensional >= 0) laws[codimensional] = 1;
  }
}

// Marks each cut-down law for which the whole law that it replaces is marked, and no other one.
std::vector<char> with_cut_down(const PairTable& pairs, std::vector<char> laws) {
  for (size_t law = 0; law < laws.size(); ++law) laws[law] = laws[pairs.original_law(static_cast<int>(law))];
  return laws;
}

}  // namespace

std::vector<char> integrated_laws(const PairTable& pairs) {
  std::vector<char> laws(pairs.laws().size(), 0);
  for (const auto& [a, b] : pairs.classes().examples()) add_integrated_laws(pairs, a, b, laws);
  return with_cut_down(pairs, std::move(laws));
}

std::vector<char> integrated_laws(const PairTable& pairs, int a, int b) {
  std::vector<char> laws(pairs.laws().size(), 0);
  add_integrated_laws(pairs, a, b, laws);
  return with_cut_down(pairs, std::move(laws));
}

TangentBasis tangents_of(const Vec3& normal) {
  TangentBasis basis;
  basis.col(0) = normal.unitOrthogonal();
  basis.col(1) = normal.cross(basis.col(0));
  return basis;
}

ContactPoints contact_points(const ContactPointsRequest& request) {
  request.system.require_at(request.x);
  return request.system.potential().points(request);
}

ContactPoints points_of_stencils(const ContactPointsRequest& request) {
  ContactPoints out;
  add_points_of_features(request, out);
  const ContactSet& set = request.system.contacts();
  for (size_t i = 0; i < set.edge_edge.size(); ++i)
    if (request.wanted[set.edge_edge[i].law])
      out.of<4>().push_back(edge_point(request, set.edge_edge[i], set.mollifier_threshold[i]));
  return out;
}

}  // namespace tack
