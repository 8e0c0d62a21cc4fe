#include "framework/core/damping_terms.hpp"

#include <fmt/format.h>

#include <numeric>
#include <stdexcept>

#include "framework/core/records.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// C d of one stencil; d: at its vertices.
void multiply(const double* blocks, int arity, const int* vertices, const VecX& d, double* out) {
  std::fill(out, out + 3 * arity, 0.0);
  for (int i = 0; i < arity; ++i) {
    for (int j = 0; j <= i; ++j, blocks += 9) {
      const Eigen::Map<const Mat3> block(blocks);
      Eigen::Map<Vec3>(out + 3 * i) += block * vertex(d, vertices[j]);
      if (j < i) Eigen::Map<Vec3>(out + 3 * j) += block.transpose() * vertex(d, vertices[i]);
    }
  }
}

std::vector<StencilBatch> checked(std::vector<StencilBatch> batches) {
  for (const StencilBatch& b : batches)
    if (const int most = b.rank_one ? largest_rank_one : largest_arity; b.arity < 1 || b.arity > most)
      throw std::logic_error(fmt::format("damping: stencils of {} vertices, and {} are the most (framework/core/term.hpp)", b.arity, most));
  return batches;
}

size_t slots_of(const std::vector<StencilBatch>& batches, int (*per_stencil)(int arity)) {
  size_t slots = 0;
  for (const StencilBatch& b : batches) slots += static_cast<size_t>(per_stencil(b.arity)) * b.count;
  return slots;
}

}  // namespace

DampingTerm::DampingTerm(std::vector<StencilBatch> batches)
    : Term("damping"), batches_(checked(std::move(batches))), blocks_(9 * slots_of(batches_, hessian_blocks)) {}

void DampingTerm::begin_step(const StepStart& start) {
  start_ = start.x;
  h_ = start.h;
  velocity_ = start.velocity ? *start.velocity : EndVelocity{1 / start.h, start.x};
}

void DampingTerm::publish(Records& records) const {
  ForceRecord force{"damping"};
  force.stored = false;
  force.add = [this](const VecX& x, std::string_view, VecX& forces) {
    if (h_ > 0) add_mean_forces(x, forces);
  };
  records.add(std::move(force));
  records.add(FlowRecord{"damping", {{"dissipated_damping"}}, [this](const VecX& x, double* amounts) { amounts[0] = dissipated(x); }});
}

double DampingTerm::square(const VecX& d) const {
  double sum = 0;
  const double* blocks = blocks_.data();
  for (const StencilBatch& b : batches_) {
    const size_t slots = 9 * static_cast<size_t>(hessian_blocks(b.arity));
    sum += sum_chunks(b.count, [&](int first, int last) {
      double part = 0, product[3 * largest_rank_one];
      for (int s = first; s < last; ++s) {
        const int* vertices = b.vertices + b.arity * static_cast<size_t>(s);
        multiply(blocks + slots * s, b.arity, vertices, d, product);
        for (int i = 0; i < b.arity; ++i) part += vertex(d, vertices[i]).dot(Eigen::Map<const Vec3>(product + 3 * i));
      }
      return part;
    });
    blocks += slots * b.count;
  }
  return sum;
}

double DampingTerm::value(const VecX& x) const { return velocity_.rate / 2 * square(x - velocity_.still); }

double DampingTerm::dissipated(const VecX& x) const { return std::max(0.0, square(x - start_) / h_); }

void DampingTerm::derivatives(const VecX& x, Projection, double* gradient, double* hessian) const {
  const VecX v = velocity_.rate * (x - velocity_.still);
  const double* blocks = blocks_.data();
  for (const StencilBatch& b : batches_) {
    const size_t slots = 9 * static_cast<size_t>(hessian_blocks(b.arity)), width = 3 * static_cast<size_t>(b.arity);
    for_each(b.count, [&](int s) {
      multiply(blocks + slots * s, b.arity, b.vertices + b.arity * static_cast<size_t>(s), v, gradient + width * s);
      if (!hessian) return;
      for (size_t k = slots * s; k < slots * (s + 1); ++k) hessian[k] = velocity_.rate * blocks[k];
    });
    blocks += slots * b.count;
    gradient += width * b.count;
    if (hessian) hessian += slots * b.count;
  }
}

void DampingTerm::add_mean_forces(const VecX& x, VecX& forces) const {
  const VecX v = (x - start_) / h_;
  const double* blocks = blocks_.data();
  for (const StencilBatch& b : batches_) {
    double product[3 * largest_rank_one];
    for (int s = 0; s < b.count; ++s, blocks += 9 * hessian_blocks(b.arity)) {
      const int* vertices = b.vertices + b.arity * static_cast<size_t>(s);
      multiply(blocks, b.arity, vertices, v, product);
      for (int i = 0; i < b.arity; ++i) vertex(forces, vertices[i]) -= Eigen::Map<const Vec3>(product + 3 * i);
    }
  }
}

StiffnessDamping::StiffnessDamping(const Term& elastic, double beta)
    : DampingTerm(elastic.batches()), elastic_(elastic), beta_(beta),
      gradient_(3 * slots_of(elastic.batches(), [](int arity) { return arity; })) {}

void StiffnessDamping::begin_step(const StepStart& start) {
  DampingTerm::begin_step(start);
  elastic_.derivatives(start.x, Projection::clamp, gradient_.data(), blocks().data());
  for (double& number : blocks()) number *= beta_;
}

MassDamping::MassDamping(int first_vertex, int count, const VecX& mass, double alpha)
    : MassDamping([&] {
        std::vector<int> vertices(count);
        std::iota(vertices.begin(), vertices.end(), first_vertex);
        return vertices;
      }(), mass, alpha) {}

// The batch points at the vertices, which a move leaves where they are.
MassDamping::MassDamping(std::vector<int> vertices, const VecX& mass, double alpha)
    : DampingTerm({{1, static_cast<int>(vertices.size()), vertices.data()}}), vertices_(std::move(vertices)) {
  for (size_t i = 0; i < vertices_.size(); ++i)
    Eigen::Map<Mat3>{blocks().data() + 9 * i} = alpha * mass(vertices_[i]) * Mat3::Identity();
}

}  // namespace tack
