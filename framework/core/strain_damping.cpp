// Damping of the strain rate (damping_terms.hpp): by stencils without their rotation, and by the
// strains of a StrainView.
#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

#include "framework/core/corotation.hpp"
#include "framework/core/damping_terms.hpp"
#include "framework/core/strain_view.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

using Column = Corotation::Column;
using Square = Corotation::Square;

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

// Returns the positions of the vertices of stencil s of the batch.
Column positions(const VecX& x, const StencilBatch& b, int s) {
  Column at(3 * b.arity);
  for (int i = 0; i < b.arity; ++i) at.segment<3>(3 * i) = vertex(x, b.vertices[b.arity * static_cast<size_t>(s) + i]);
  return at;
}

// Returns the symmetric matrix whose lower triangle, by rows, is given by blocks.
Square matrix_of(const double* blocks, int arity) {
  Square k(3 * arity, 3 * arity);
  for (int i = 0; i < arity; ++i)
    for (int j = 0; j <= i; ++j, blocks += 9) {
      const Eigen::Map<const Mat3> block(blocks);
      k.block<3, 3>(3 * i, 3 * j) = block;
      if (j < i) k.block<3, 3>(3 * j, 3 * i) = block.transpose();
    }
  return k;
}

// Returns whether the sum of the blocks of K exceeds round-off.
bool resists_translation(const double* blocks, const StencilBatch& b) {
  constexpr double round_off = 1e-9;
  Mat3 sum = Mat3::Zero();
  double size = 0;
  for (int i = 0; i < b.arity - b.scalars; ++i)
    for (int j = 0; j <= i; ++j, blocks += 9) {
      const Eigen::Map<const Mat3> block(blocks);
      sum += block;
      if (j < i) sum += block.transpose();
      size += block.cwiseAbs().maxCoeff();
    }
  return sum.cwiseAbs().maxCoeff() > round_off * size;
}

void zero(double* gradient, size_t gradient_slots, double* hessian, size_t hessian_slots) {
  std::fill_n(gradient, gradient_slots, 0.0);
  if (hessian) std::fill_n(hessian, hessian_slots, 0.0);
}

class CorotatedDamping : public DampingTerm {
 public:
  CorotatedDamping(const Term& elastic, double beta)
      : elastic_(elastic), beta_(beta), batches_(checked(elastic.batches())), blocks_(9 * slots_of(batches_, hessian_blocks)),
        gradient_(3 * slots_of(batches_, [](int arity) { return arity; })), still_(gradient_.size()),
        translates_(slots_of(batches_, [](int) { return 1; })) {}

  void begin_step(const StepStart& start) override {
    DampingTerm::begin_step(start);
    elastic_.derivatives(start.x, Projection::clamp, gradient_.data(), blocks_.data());
    for (double& number : blocks_) number *= beta_;
    double* still = still_.data();
    const double* first_block = blocks_.data();
    char* translates = translates_.data();
    for (const StencilBatch& b : batches_) {
      const size_t width = 3 * static_cast<size_t>(b.arity), blocks = 9 * static_cast<size_t>(hessian_blocks(b.arity));
      for_each(b.count, [&](int s) {
        translates[s] = resists_translation(first_block + blocks * s, b);
        const Column from = positions(start_, b, s), displacement = positions(velocity_.still, b, s) - from;
        Eigen::Map<VecX>(still + width * s, static_cast<Eigen::Index>(width)) = from + Corotation::without_rotation(b.arity - b.scalars, from, displacement);
      });
      still += width * b.count;
      first_block += blocks * b.count;
      translates += b.count;
    }
  }

  std::vector<StencilBatch> batches() const override { return batches_; }

  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    if (!begun()) return zero(gradient, gradient_.size(), hessian, blocks_.size());
    const double *first_block = blocks_.data(), *still = still_.data();
    const char* translates = translates_.data();
    for (const StencilBatch& b : batches_) {
      const size_t blocks = 9 * static_cast<size_t>(hessian_blocks(b.arity)), width = 3 * static_cast<size_t>(b.arity);
      for_each(b.count, [&](int s) {
        const Square k = matrix_of(first_block + blocks * s, b.arity);
        const Corotation stencil(b.arity - b.scalars, Eigen::Map<const VecX>(still + width * s, static_cast<Eigen::Index>(width)), positions(x, b, s), translates[s]);
        const Column f = k * stencil.u();
        Eigen::Map<VecX>(gradient + width * s, static_cast<Eigen::Index>(width)) = velocity_.rate * stencil.gradient(f);
        if (!hessian) return;
        // The projected Hessian omits second derivatives of the strain: u is only the strain of one step.
        Square h;
        if (projection == Projection::none && !b.rank_one) {
          h = stencil.hessian(k, f);
        } else {
          const Square slopes = stencil.slopes();
          h = slopes.transpose() * (k * slopes);
        }
        double* out = hessian + blocks * s;
        for (int i = 0; i < b.arity; ++i)
          for (int j = 0; j <= i; ++j, out += 9) Eigen::Map<Mat3>{out} = velocity_.rate * h.block<3, 3>(3 * i, 3 * j);
      });
      first_block += blocks * b.count;
      still += width * b.count;
      translates += b.count;
      gradient += width * b.count;
      if (hessian) hessian += blocks * b.count;
    }
  }

  void add_mean_forces(const VecX& x, VecX& forces) const override {
    const double* blocks = blocks_.data();
    const char* translates = translates_.data();
    for (const StencilBatch& b : batches_)
      for (int s = 0; s < b.count; ++s, ++translates, blocks += 9 * hessian_blocks(b.arity)) {
        const Corotation stencil(b.arity - b.scalars, positions(start_, b, s), positions(x, b, s), *translates);
        const Column force = stencil.gradient(matrix_of(blocks, b.arity) * stencil.u()) / h_;
        for (int i = 0; i < b.arity; ++i) vertex(forces, b.vertices[b.arity * static_cast<size_t>(s) + i]) -= force.segment<3>(3 * i);
      }
  }

 private:
  double square(const VecX& x, Reference from) const override {
    double sum = 0;
    const double *first_block = blocks_.data(), *still = still_.data();
    const char* translates = translates_.data();
    for (const StencilBatch& b : batches_) {
      const size_t blocks = 9 * static_cast<size_t>(hessian_blocks(b.arity)), width = 3 * static_cast<size_t>(b.arity);
      sum += sum_chunks(b.count, [&](int first, int last) {
        double partial = 0;
        for (int s = first; s < last; ++s) {
          const Column reference = from == Reference::start ? positions(start_, b, s) : Column(Eigen::Map<const VecX>(still + width * s, static_cast<Eigen::Index>(width)));
          const Column u = Corotation(b.arity - b.scalars, reference, positions(x, b, s), translates[s]).u();
          partial += u.dot(matrix_of(first_block + blocks * s, b.arity) * u);
        }
        return partial;
      });
      first_block += blocks * b.count;
      still += width * b.count;
      translates += b.count;
    }
    return sum;
  }

  const Term& elastic_;
  double beta_;
  std::vector<StencilBatch> batches_;
  std::vector<double> blocks_;    // beta K of each stencil, in the Hessian's slots [kg/s]
  std::vector<double> gradient_;  // written, not read
  std::vector<double> still_;     // reference of the displacements of each stencil, in gradient slots [m]
  std::vector<char> translates_;  // of each stencil: it resists translation
};

class StrainViewDamping : public DampingTerm {
 public:
  StrainViewDamping(const Term& elastic, const StrainView& view, double beta) : elastic_(elastic), view_(view), beta_(beta) {
    const std::vector<StencilBatch> batches = checked(elastic.batches());
    gradient_slots_ = 3 * slots_of(batches, [](int arity) { return arity; });
    hessian_slots_ = 9 * slots_of(batches, hessian_blocks);
  }

  void begin_step(const StepStart& start) override {
    DampingTerm::begin_step(start);
    from_ = view_.strains(start.x);
    still_ = from_;
    // A small fraction of the displacement gives the derivative of the strains along it.
    constexpr double fraction = 1.0 / 64;
    const VecX displacement = fraction * (velocity_.still - start.x);
    if (!displacement.isZero(0)) still_ += (view_.strains(start.x + displacement) - view_.strains(start.x - displacement)) / (2 * fraction);
  }

  std::vector<StencilBatch> batches() const override { return elastic_.batches(); }

  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian) const override {
    if (!begun()) return zero(gradient, gradient_slots_, hessian, hessian_slots_);
    view_.derivatives_from(x, still_, projection, gradient, hessian);
    const double scale = beta_ * velocity_.rate;
    std::for_each(gradient, gradient + gradient_slots_, [&](double& g) { g *= scale; });
    if (hessian) std::for_each(hessian, hessian + hessian_slots_, [&](double& h) { h *= scale; });
  }

  void add_mean_forces(const VecX& x, VecX& forces) const override {
    std::vector<double> gradient(gradient_slots_);
    view_.derivatives_from(x, from_, Projection::none, gradient.data(), nullptr);
    const double* slot = gradient.data();
    for (const StencilBatch& b : elastic_.batches())
      for (int k = 0; k < b.arity * b.count; ++k, slot += 3) vertex(forces, b.vertices[k]) -= beta_ / h_ * Eigen::Map<const Vec3>(slot);
  }

 private:
  double square(const VecX& x, Reference from) const override { return 2 * beta_ * view_.value_from(x, from == Reference::start ? from_ : still_); }

  const Term& elastic_;
  const StrainView& view_;
  double beta_;
  size_t gradient_slots_, hessian_slots_;
  VecX from_, still_;  // strains at the start, and those from which the rates count
};

}  // namespace

std::unique_ptr<DampingTerm> stiffness_damping(const Term& elastic, double beta) {
  if (const auto* view = dynamic_cast<const StrainView*>(&elastic)) return std::make_unique<StrainViewDamping>(elastic, *view, beta);
  return std::make_unique<CorotatedDamping>(elastic, beta);
}

}  // namespace tack
