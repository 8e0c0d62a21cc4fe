#include "framework/assembly/stencil_clamp.hpp"

#include <algorithm>
#include <stdexcept>

#include "framework/assembly/psd_projection.hpp"
#include "framework/assembly/stencil_blocks.hpp"

namespace tack {
namespace {

template <int K>
void clamp_slots(double* slots) {
  Eigen::Matrix<double, 3 * K, 3 * K> hessian;
  load_blocks<K>(slots, hessian);
  project_stencil_psd<K>(hessian, Projection::clamp);
  store_blocks<K>(hessian, slots);
}

static_assert(largest_arity == 10);

void clamp_slots(int arity, double* slots) {
  switch (arity) {
    case 1: return;  // masses
    case 2: return clamp_slots<2>(slots);
    case 3: return clamp_slots<3>(slots);
    case 4: return clamp_slots<4>(slots);
    case 5: return clamp_slots<5>(slots);
    case 6: return clamp_slots<6>(slots);
    case 7: return clamp_slots<7>(slots);
    case 8: return clamp_slots<8>(slots);
    case 9: return clamp_slots<9>(slots);
    case 10: return clamp_slots<10>(slots);
  }
  throw std::logic_error("no projection of stencils of this arity");
}

// c v v^T is negative if its trace is.
void clamp_rank_one(int arity, double* slots) {
  double trace = 0;
  for (int i = 0; i < arity; ++i) trace += Eigen::Map<const Mat3>(slots + 9 * (hessian_blocks(i + 1) - 1)).trace();
  if (trace < 0) std::fill_n(slots, 9 * hessian_blocks(arity), 0.0);
}

void clamp_stencil(const StencilBatch& batch, double* slots) {
  if (batch.rank_one) clamp_rank_one(batch.arity, slots);
  else if (batch.twists > 0) project_twisted_slots(slots, Projection::clamp);
  else clamp_slots(batch.arity, slots);
}

}  // namespace

void project_twisted_slots(double* slots, Projection projection) {
  Eigen::Matrix<double, 15, 15> hessian;
  load_blocks<5>(slots, hessian);
  project_twisted_psd(hessian, projection);
  store_blocks<5>(hessian, slots);
}

void clamp_stencils(const StencilBatch& batch, int first, int last, const std::vector<char>& flags, const DofMap& dofs,
                    double* slots) {
  const auto flagged = [&](int vertex) {
    if (dofs.block(vertex) >= 0) return flags[dofs.block(vertex)] != 0;
    if (!dofs.mixed(vertex)) return false;
    const auto blocks = dofs.blocks(vertex);
    return std::any_of(blocks.begin(), blocks.end(), [&](const DofMap::Part& part) { return flags[part.leaf] != 0; });
  };
  for (int s = first; s < last; ++s, slots += 9 * hessian_blocks(batch.arity)) {
    const int* v = batch.vertices + static_cast<size_t>(batch.arity) * s;
    if (std::any_of(v, v + batch.arity, flagged)) clamp_stencil(batch, slots);
  }
}

}  // namespace tack
