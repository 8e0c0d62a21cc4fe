#include "solvers/minimizers/residual_model.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Pull without inertia, as a fraction of the model's diagonal: weak enough to leave Gauss-Newton
// steps unchanged, strong enough that the target stays within a million step lengths.
constexpr double weak_pull = 1e-6;

}  // namespace

ResidualModel::ResidualModel(Objective& objective) : squares_(objective.least_squares()), x_(squares_.x) {
  squares_.dofs.gather(x_, q_);
  constrained_.assign(squares_.dofs.block_count(), -1);
  for (size_t i = 0; i < squares_.dofs.partly_fixed_blocks().size(); ++i)
    constrained_[squares_.dofs.partly_fixed_blocks()[i].block] = static_cast<int>(i);
  lay_out();
  fold(objective.gradient());
}

void ResidualModel::lay_out() {
  for (const ResidualView* view : squares_.views) {
    view_start_.push_back({r_.size(), of_vertices_.size()});
    for (const ResidualBatch& batch : view->residual_batches())
      for (int s = 0; s < batch.count; ++s) add(batch, batch.vertices + static_cast<size_t>(batch.arity) * s);
  }
}

void ResidualModel::add(const ResidualBatch& batch, const int* vertices) {
  const DofMap& dofs = squares_.dofs;
  const auto for_each_part = [&](int v, const auto& act) {
    if (dofs.block(v) >= 0) act(dofs.block(v), 1.0);
    else if (dofs.mixed(v))
      for (const DofMap::WeightedIndex& entry : dofs.blocks(v)) act(entry.index, entry.weight);
  };
  const size_t first_block = blocks_.size(), first_weight = weights_.size();
  const auto place_of = [&](int block) { return std::find(blocks_.begin() + static_cast<std::ptrdiff_t>(first_block), blocks_.end(), block); };
  for (int i = 0; i < batch.arity; ++i)
    for_each_part(vertices[i], [&](int block, double) {
      if (place_of(block) == blocks_.end()) blocks_.push_back(block);
    });
  const size_t blocks = blocks_.size() - first_block;
  weights_.resize(first_weight + batch.arity * blocks, 0.0);
  for (int i = 0; i < batch.arity; ++i)
    for_each_part(vertices[i], [&](int block, double weight) {
      const size_t k = static_cast<size_t>(place_of(block) - blocks_.begin()) - first_block;
      weights_[first_weight + i * blocks + k] = weight;
    });
  stencils_.push_back({batch.arity, batch.residuals, static_cast<int>(blocks), r_.size(), of_vertices_.size(),
                       jacobian_.size(), first_block, first_weight});
  r_.resize(r_.size() + batch.residuals);
  of_vertices_.resize(of_vertices_.size() + static_cast<size_t>(batch.residuals) * 3 * batch.arity);
  jacobian_.resize(jacobian_.size() + static_cast<size_t>(batch.residuals) * 3 * blocks);
}

// Computes the Jacobian by the unknowns, Jacobian times W, without constrained directions.
void ResidualModel::reduce(const Stencil& s) {
  using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  const Eigen::Map<const Rows> own(of_vertices_.data() + s.first_of_vertices, s.residuals, 3 * s.arity);
  Eigen::Map<Rows> reduced(jacobian_.data() + s.first_jacobian, s.residuals, 3 * s.blocks);
  reduced.setZero();
  for (int i = 0; i < s.arity; ++i)
    for (int k = 0; k < s.blocks; ++k)
      if (const double weight = weights_[s.first_weight + static_cast<size_t>(i) * s.blocks + k]; weight != 0)
        reduced.middleCols(3 * k, 3) += weight * own.middleCols(3 * i, 3);
  for (int k = 0; k < s.blocks; ++k)
    if (const int fixed = constrained_[blocks(s)[k]]; fixed >= 0)
      reduced.middleCols(3 * k, 3) -= (reduced.middleCols(3 * k, 3) * squares_.dofs.partly_fixed_blocks()[fixed].projection).eval();
}

bool ResidualModel::evaluate(bool with_jacobian) {
  squares_.dofs.scatter(q_, x_);
  for (size_t v = 0; v < squares_.views.size(); ++v)
    if (!squares_.views[v]->residuals(x_, r_.data() + view_start_[v].first,
                                      with_jacobian ? of_vertices_.data() + view_start_[v].second : nullptr))
      return false;
  bool finite = true;
  const auto multiply = [&](std::vector<double>& numbers, size_t first, size_t last, double root) {
    for (size_t i = first; i < last; ++i) finite = std::isfinite(numbers[i] *= root) && finite;
  };
  for (size_t v = 0; v < squares_.views.size(); ++v) {
    const bool end = v + 1 == squares_.views.size();
    const double root = std::sqrt(squares_.scales[v]);
    multiply(r_, view_start_[v].first, end ? r_.size() : view_start_[v + 1].first, root);
    if (with_jacobian)
      multiply(of_vertices_, view_start_[v].second, end ? of_vertices_.size() : view_start_[v + 1].second, root);
  }
  if (with_jacobian)
    for (const Stencil& s : stencils_) reduce(s);
  return finite;
}

// Sets the target by M (q0 - target) = gradient - J^T r.
void ResidualModel::fold(const VecX& gradient) {
  evaluate(true);
  const DofMap& dofs = squares_.dofs;
  VecX rest = gradient, diagonal = VecX::Zero(dofs.block_count());
  for (const Stencil& s : stencils_) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> jacobian(this->jacobian(s), s.residuals, 3 * s.blocks);
    const Eigen::Map<const VecX> r(residuals(s), s.residuals);
    for (int k = 0; k < s.blocks; ++k) {
      const int b = this->blocks(s)[k];
      rest.segment<3>(3 * b) -= jacobian.middleCols(3 * k, 3).transpose() * r;
      diagonal(b) += jacobian.middleCols(3 * k, 3).squaredNorm() / 3;
    }
  }
  const double largest = std::max(diagonal.maxCoeff(), 1e-300);
  root_mass_.resize(dofs.block_count());
  target_.resize(dofs.size());
  for (int b = 0; b < dofs.block_count(); ++b) {
    double mass = squares_.block_mass(b);
    if (mass == 0) mass = weak_pull * (diagonal(b) > 0 ? diagonal(b) : largest);
    root_mass_(b) = std::sqrt(mass);
    target_.segment<3>(3 * b) = q_.segment<3>(3 * b) - rest.segment<3>(3 * b) / mass;
  }
}

}  // namespace tack
