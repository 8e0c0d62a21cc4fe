#include "energies/solid/composite_tets.hpp"

#include <Eigen/LU>
#include <algorithm>

namespace tack {
namespace {

// x c^T of a node, added up.
void add_outer(const CompositeNodes& x, int node, const CompositeTable::Row& c, PackMat3& sum) {
  for (int j = 0; j < 3; ++j)
    for (int i = 0; i < 3; ++i) sum(i, j) += c[j] * x(i, node);
}

}  // namespace

CompositeTets::CompositeTets(const Body& body, const VecX& rest) : parts_(body.tets), nodes_(composite_tets_of(body.tets)) {
  const std::vector<TetRest<double>> of_parts = tet_rest_data(body, rest);
  const size_t all = (nodes_.size() + pack_width - 1) / pack_width;
  shape_.resize(all);
  volume_.resize(all);
  for (size_t i = 0; i < all * pack_width; ++i) {
    const size_t t = std::min(i, nodes_.size() - 1);
    const Tet corners{nodes_[t][0], nodes_[t][1], nodes_[t][2], nodes_[t][3]};
    double volume = 0;
    for (int s = 0; s < composite_parts; ++s) volume += of_parts[composite_parts * t + s].volume;
    const int lane = static_cast<int>(i % pack_width);
    set_lane<3, 3>(shape_[i / pack_width], lane, edges_of(corners, rest).inverse());
    volume_[i / pack_width].set(lane, volume);
  }
}

CompositeNodes CompositeTets::at(int first, int n, const VecX& x) const {
  CompositeNodes out;
  for (int l = 0; l < pack_width; ++l) {
    const CompositeTet& tet = nodes_[first + (l < n ? l : n - 1)];
    for (int a = 0; a < composite_nodes; ++a)
      for (int d = 0; d < 3; ++d) out(d, a).set(l, x[3 * tet[a] + d] - x[3 * tet[0] + d]);
  }
  return out;
}

CompositePoints CompositeTets::points(int pack, const CompositeNodes& x) const {
  CompositePoints points;
  points.growth = 0;
  for (int q = 0; q < composite_points; ++q) {
    PackMat3 edges = PackMat3::Zero();
    for (int a = 0; a < composite_nodes; ++a) add_outer(x, a, table_.point[q][a], edges);
    points.f[q] = edges * shape(pack, q);
    points.growth += 0.25 * volume_growth(points.f[q]);
  }
  return points;
}

PackMat3 CompositeTets::part(int pack, int s, const CompositeNodes& x) const {
  PackMat3 edges = PackMat3::Zero();
  for (int i = 0; i < 4; ++i) add_outer(x, composite_tets[s][i], table_.part[s][i], edges);
  return edges * shape(pack, composite_points + s);
}

Mat3 CompositeTets::deformation(int tet, int k, const VecX& x) const {
  Mat3 edges = Mat3::Zero();
  const Vec3 origin = vertex(x, nodes_[tet][0]);
  const auto add = [&](int node, const CompositeTable::Row& c) {
    edges += (vertex(x, nodes_[tet][node]) - origin) * Eigen::Map<const Vec3>(c.data()).transpose();
  };
  if (k < composite_points)
    for (int a = 0; a < composite_nodes; ++a) add(a, table_.point[k][a]);
  else
    for (int i = 0; i < 4; ++i) add(composite_tets[k - composite_points][i], table_.part[k - composite_points][i]);
  return edges * shape_of(tet, k);
}

}  // namespace tack
