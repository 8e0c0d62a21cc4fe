// Plastic part of fans of dihedral edges: trial state, return mapping, derivatives and work (fan_stencils.hpp).
#include <algorithm>
#include <cmath>
#include <limits>

#include "energies/shell/fan_stencils.hpp"
#include "geometry/parallel.hpp"

namespace tack {

void FanStencils::set_yield(const double* yields, double hardening) {
  hardening_ = hardening;
  Angles none;
  none.fill(0);
  plastic_.assign(resting_.size(), none);
  unstressed_ = resting_;
  yielded_.assign(resting_.size(), Pack(0));
  initial_.resize(resting_.size());
  for (int p = 0; p < packs(); ++p)
    for (int l = 0; l < pack_width; ++l) initial_[p].set(l, yields[p * pack_width + std::min(l, lanes(p) - 1)]);
}

void FanStencils::set_flow(const FanFlow& stored) {
  for (int p = 0; p < packs(); ++p)
    for (int l = 0; l < pack_width; ++l) {
      const int f = p * pack_width + std::min(l, lanes(p) - 1);
      yielded_[p].set(l, stored.flow[f]);
      for (int i = 0; i < shape_.edge_count; ++i) plastic_[p][i].set(l, stored.angles[f * shape_.edge_count + i]);
    }
  for (int p = 0; p < packs(); ++p)
    for (int i = 0; i < shape_.edge_count; ++i) resting_[p][i] = unstressed_[p][i] + plastic_[p][i];
}

FanStencils::Trial FanStencils::trial(int pack, const VecX& x) const {
  Corners at;
  DihedralEdges all;
  corners(pack, x, at);
  find_edges(at, all);
  Trial t;
  Pack square = 0;
  for (int i = 0; i < shape_.edge_count; ++i) {
    t.a[i] = unwound(pack, i, all[i].angle) - resting_[pack][i];
    Pack moment = 0.5 * c(pack, i, i) * t.a[i];
    for (int k = 0; k < i; ++k) moment += c(pack, i, k) * t.a[k];
    square += 2 * t.a[i] * moment;
  }
  t.size = sqrt(select(square < 0, 0, square));
  t.flow = flowing(t.size, initial_[pack] + hardening_ * yielded_[pack]);
  return t;
}

void FanStencils::flow(const VecX& x, double* angles, double* flow) const {
  for_each(packs(), [&](int p) {
    const Trial t = trial(p, x);
    for (int l = 0; l < lanes(p); ++l) {
      const int f = p * pack_width + l;
      flow[f] = yielded_[p][l] + t.flow[l];
      const double part = t.flow[l] > 0 ? t.flow[l] / t.size[l] : 0;
      for (int i = 0; i < shape_.edge_count; ++i) angles[f * shape_.edge_count + i] = plastic_[p][i][l] + part * t.a[i][l];
    }
  }, chunk_size / pack_width);
}

double FanStencils::plastic_value(const VecX& x) const {
  return sum_chunks(count_, [&](int first, int last) {
    double sum = 0;
    for (int f = first; f < last; f += pack_width) {
      const int p = f / pack_width;
      const Trial t = trial(p, x);
      const Pack left = t.size - t.flow;
      const Pack energy = 0.5 * left * left + t.flow * (initial_[p] + hardening_ * yielded_[p] + hardening_ / 2 * t.flow);
      for (int l = 0; l < lanes(p); ++l) sum += energy[l];
    }
    return std::isnan(sum) ? std::numeric_limits<double>::infinity() : sum;  // a triangle without area
  });
}

// With g = J^T C a and J the gradients of the angles, t grad t = g. The gradient of phi is secant g. Its Hessian is secant times that of t^2 / 2 plus
// rank_one g g^T; J^T (secant C + rank_one (C a) (C a)^T) J is positive semi-definite, and so is secant times the projected part of the moments.
void FanStencils::let_flow(const VecX& x, int first, int last, double* gradient, double* hessian) const {
  const int arity = shape_.arity(), width = 3 * arity, slots = 9 * hessian_blocks(arity);
  for (int f = first; f < last; f += pack_width) {
    const int p = f / pack_width;
    const Trial t = trial(p, x);
    for (int l = 0; l < lanes(p); ++l) {
      if (!(t.flow[l] > 0)) continue;
      const double secant = 1 - t.flow[l] / t.size[l];
      const double rank_one = (hardening_ / (1 + hardening_) - secant) / (t.size[l] * t.size[l]);
      double* const g = gradient + static_cast<size_t>(f - first + l) * static_cast<size_t>(width);
      if (hessian) {
        double* block = hessian + static_cast<size_t>(f - first + l) * static_cast<size_t>(slots);
        for (int v = 0; v < arity; ++v)
          for (int w = 0; w <= v; ++w, block += 9)
            for (int k = 0; k < 9; ++k) block[k] = secant * block[k] + rank_one * g[3 * v + k % 3] * g[3 * w + k / 3];
      }
      for (int k = 0; k < width; ++k) g[k] *= secant;
    }
  }
}

double FanStencils::dissipated(const VecX& x) const {
  return sum_chunks(count_, [&](int first, int last) {
    double sum = 0;
    for (int f = first; f < last; f += pack_width) {
      const int p = f / pack_width;
      const Trial t = trial(p, x);
      const Pack work = t.flow * (initial_[p] + hardening_ * yielded_[p] + hardening_ / 2 * t.flow);
      for (int l = 0; l < lanes(p); ++l) sum += work[l];
    }
    return sum;
  });
}

}  // namespace tack
