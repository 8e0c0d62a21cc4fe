#include "framework/world/consistent_mass.hpp"

#include <Eigen/SparseCholesky>
#include <vector>

namespace tack {
namespace {

// Calls action with each block that moves a vertex, and its weight.
template <class Action>
void for_each_block(const DofMap& dofs, int v, const Action& action) {
  if (dofs.mixed(v)) {
    for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) action(entry.index, entry.weight);
  } else if (dofs.block(v) >= 0) {
    action(dofs.block(v), 1.0);
  }
}

}  // namespace

VecX divide_by_mass(const DofMap& dofs, const VecX& mass, const VecX& f) {
  using Triplet = Eigen::Triplet<double>;
  std::vector<Mat3> free(static_cast<size_t>(dofs.block_count()), Mat3::Identity());
  for (const DofMap::PartlyFixedBlock& h : dofs.partly_fixed_blocks()) free[static_cast<size_t>(h.block)] -= h.projection;
  VecX diagonal = VecX::Zero(dofs.block_count()), rhs(dofs.size());
  std::vector<Triplet> entries;
  const auto add = [&](int a, int b, const Mat3& m) {
    for (int i = 0; i < 3; ++i)
      for (int j = 0; j < 3; ++j)
        if (m(i, j) != 0) entries.emplace_back(3 * a + i, 3 * b + j, m(i, j));
  };
  for (int v = 0; v < dofs.vertex_count(); ++v) {
    if (mass(v) == 0) continue;
    for_each_block(dofs, v, [&](int a, double wa) {
      diagonal(a) += mass(v) * wa * wa;
      for_each_block(dofs, v, [&](int b, double wb) { add(a, b, mass(v) * wa * wb * free[static_cast<size_t>(a)] * free[static_cast<size_t>(b)]); });
    });
  }
  for (int b = 0; b < dofs.block_count(); ++b) {
    const Mat3& open = free[static_cast<size_t>(b)];
    const double moved = diagonal(b);
    add(b, b, (moved > 0 ? moved : 1) * (moved > 0 ? Mat3(Mat3::Identity() - open) : Mat3(Mat3::Identity())));
    rhs.segment<3>(3 * b) = moved > 0 ? Vec3(open * f.segment<3>(3 * b)) : Vec3::Zero();
  }
  Eigen::SparseMatrix<double> matrix(dofs.size(), dofs.size());
  matrix.setFromTriplets(entries.begin(), entries.end());
  return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(rhs);
}

void project_velocities(const DofMap& dofs, const VecX& mass, VecX& v) {
  VecX momentum = VecX::Zero(dofs.size()), q;
  for (int i = 0; i < dofs.vertex_count(); ++i)
    if (mass(i) > 0)
      for_each_block(dofs, i, [&](int b, double w) { momentum.segment<3>(3 * b) += w * mass(i) * vertex(v, i); });
  q = divide_by_mass(dofs, mass, momentum);
  for (int b = 0; b < dofs.block_count(); ++b) vertex(v, dofs.vertex_of_block(b)) = q.segment<3>(3 * b);
  dofs.update_dependents(v);
}

}  // namespace tack
