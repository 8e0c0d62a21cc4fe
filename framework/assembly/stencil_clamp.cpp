#include "framework/assembly/stencil_clamp.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/assembly/mixed_projection.hpp"
#include "framework/assembly/psd_projection.hpp"
#include "framework/assembly/stencil_blocks.hpp"

namespace tack {
namespace {

template <int K>
void project(double* slots, Projection projection) {
  Eigen::Matrix<double, 3 * K, 3 * K> hessian;
  load_blocks<K>(slots, hessian);
  project_stencil_psd<K>(hessian, projection);
  store_blocks<K>(hessian, slots);
}

static_assert(largest_arity == 10);

void project_relative(int arity, double* slots, Projection projection) {
  switch (arity) {
    case 1: return;  // masses
    case 2: return project<2>(slots, projection);
    case 3: return project<3>(slots, projection);
    case 4: return project<4>(slots, projection);
    case 5: return project<5>(slots, projection);
    case 6: return project<6>(slots, projection);
    case 7: return project<7>(slots, projection);
    case 8: return project<8>(slots, projection);
    case 9: return project<9>(slots, projection);
    case 10: return project<10>(slots, projection);
  }
  project_mixed_psd(arity, 0, slots, projection);
}

// c v v^T is negative if its trace is.
void project_rank_one(int arity, double* slots, Projection projection) {
  double trace = 0;
  for (int i = 0; i < arity; ++i) trace += Eigen::Map<const Mat3>(slots + 9 * (hessian_blocks(i + 1) - 1)).trace();
  if (trace >= 0) return;
  const double factor = projection == Projection::absolute ? -1.0 : 0.0;
  for (int i = 0; i < 9 * hessian_blocks(arity); ++i) slots[i] *= factor;
}

void project_two_scalars(double* slots, Projection projection) {
  Eigen::Matrix<double, 15, 15> hessian;
  load_blocks<5>(slots, hessian);
  project_scalar_psd(hessian, projection);
  store_blocks<5>(hessian, slots);
}

}  // namespace

void project_slots(const StencilBatch& kind, double* slots, Projection projection) {
  if (projection == Projection::none) return;
  if (kind.rank_one) project_rank_one(kind.arity, slots, projection);
  else if (kind.scalars == 2 && kind.arity == 5) project_two_scalars(slots, projection);
  else if (kind.scalars > 0) project_mixed_psd(kind.arity, kind.scalars, slots, projection);
  else project_relative(kind.arity, slots, projection);
}

void clamp_stencils(const StencilBatch& batch, int first, int last, const std::vector<char>& flags, const DofMap& dofs,
                    double* slots) {
  const auto flagged = [&](int vertex) {
    if (dofs.block(vertex) >= 0) return flags[dofs.block(vertex)] != 0;
    if (!dofs.mixed(vertex)) return false;
    const auto blocks = dofs.blocks(vertex);
    return std::any_of(blocks.begin(), blocks.end(), [&](const DofMap::WeightedIndex& entry) { return flags[entry.index] != 0; });
  };
  for (int s = first; s < last; ++s, slots += 9 * hessian_blocks(batch.arity)) {
    const int* v = batch.vertices + static_cast<size_t>(batch.arity) * s;
    if (std::any_of(v, v + batch.arity, flagged)) project_slots(batch, slots, Projection::clamp);
  }
}

}  // namespace tack
