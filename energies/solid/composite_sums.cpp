#include "energies/solid/composite_sums.hpp"

#include <algorithm>

#include "energies/solid/sample_stiffness.hpp"

namespace tack {
namespace {

PackVec3 combined(const PackMat3& m, const CompositeTable::Row& c) { return Pack(c[0]) * m.col(0) + Pack(c[1]) * m.col(1) + Pack(c[2]) * m.col(2); }

}  // namespace

CompositeSums::CompositeSums(const CompositeTets& tets, int pack, Projection projection, bool with_hessian)
    : tets_(tets), pack_(pack), projection_(projection), with_hessian_(with_hessian), gradient_(CompositeNodes::Zero()), growth_(CompositeNodes::Zero()) {
  if (with_hessian) std::fill(slots_, slots_ + hessian_size, Pack(0));
}

void CompositeSums::add_point(int q, const Svd3<Pack>& svd, const PrincipalDerivatives& psi, const Pack& pressure) {
  const PackMat3& shape = tets_.shape(pack_, q);
  const auto& c = table_.point[q];
  PrincipalDerivatives d = psi;
  for (int i = 0; i < 3; ++i) d.gradient(i) *= 1 - weight_of_parts;
  for (int i = 0; i < 9; ++i) d.hessian(i) *= 1 - weight_of_parts;
  add_pressure(d, svd.s, pressure);
  const Pack quarter = 1.0 / composite_points;
  const PackMat3 of_edges = quarter * (svd.u * d.gradient.asDiagonal() * svd.v.transpose()) * shape.transpose();
  for (int a = 0; a < composite_nodes; ++a) gradient_.col(a) += combined(of_edges, c[a]);
  if (!with_hessian_) return;
  const PackVec3 cofactor(svd.s(1) * svd.s(2), svd.s(0) * svd.s(2), svd.s(0) * svd.s(1));
  const PackMat3 of_growth = quarter * (svd.u * cofactor.asDiagonal() * svd.v.transpose()) * shape.transpose();
  for (int a = 0; a < composite_nodes; ++a) growth_.col(a) += combined(of_growth, c[a]);
  const PrincipalHessian h = principal_hessian(svd.s, d, projection_);
  SampleStiffness stiffness(svd.u, h);
  const PackMat3 principal = svd.v.transpose() * shape.transpose();
  CompositeNodes p;
  for (int a = 0; a < composite_nodes; ++a) p.col(a) = combined(principal, c[a]);
  for (int b = 0; b < composite_nodes; ++b) {
    stiffness.set(quarter * p.col(b));
    for (int a = b; a < composite_nodes; ++a) {
      auto block = slot(a, b);
      stiffness.add_to(block, p.col(a));
    }
  }
}

void CompositeSums::add_part(int s, const Svd3<Pack>& svd, const PrincipalDerivatives& psi) {
  const Pack share = CompositeTets::weight(composite_points + s);
  const PackMat3& shape = tets_.shape(pack_, composite_points + s);
  const auto& c = table_.part[s];
  const auto& corners = composite_tets[s];
  const PackMat3 of_edges = share * (svd.u * psi.gradient.asDiagonal() * svd.v.transpose()) * shape.transpose();
  for (int i = 0; i < 4; ++i) gradient_.col(corners[i]) += combined(of_edges, c[i]);
  if (!with_hessian_) return;
  const PrincipalHessian h = principal_hessian(svd.s, psi, projection_);
  SampleStiffness stiffness(svd.u, h);
  const PackMat3 principal = svd.v.transpose() * shape.transpose();
  std::array<PackVec3, 4> p;
  for (int i = 0; i < 4; ++i) p[i] = combined(principal, c[i]);
  for (int k = 0; k < 4; ++k) {
    stiffness.set(share * p[k]);
    for (int i = 0; i < 4; ++i) {
      if (corners[i] < corners[k]) continue;
      auto block = slot(corners[i], corners[k]);
      stiffness.add_to(block, p[i]);
    }
  }
}

void CompositeSums::store(const Pack& bulk, int n, double* gradient, double* hessian) {
  const Pack& volume = tets_.volume(pack_);
  for (int i = 0; i < 3 * composite_nodes; ++i) gradient_(i) *= volume;
  store_lanes(gradient_.data(), gradient_size, gradient, n);
  if (!with_hessian_) return;
  const Pack square = projected(bulk, projection_);
  for (int a = 0; a < composite_nodes; ++a)
    for (int b = 0; b <= a; ++b) slot(a, b) += (square * growth_.col(a)) * growth_.col(b).transpose();
  for (Pack& k : slots_) k *= volume;
  store_lanes(slots_, hessian_size, hessian, n);
}

}  // namespace tack
