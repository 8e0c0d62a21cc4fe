#include "solvers/minimizers/residual_model.hpp"

#include <algorithm>
#include <cmath>

namespace tack {
namespace {

// Without inertia: the pull, as a part of the model's diagonal. Weak enough to leave Gauss-Newton steps
// as they are, strong enough that the target stays within a million of them.
constexpr double weak_pull = 1e-6;

}  // namespace

ResidualModel::ResidualModel(Objective& objective) : squares_(objective.least_squares()), x_(squares_.x) {
  lay_out();
  fold(objective.gradient());
}

void ResidualModel::lay_out() {
  size_t first = 0, first_jacobian = 0;
  for (const ResidualView* view : squares_.views) {
    view_start_.push_back({first, first_jacobian});
    for (const ResidualBatch& batch : view->residual_batches()) {
      for (int s = 0; s < batch.count; ++s) {
        stencils_.push_back({batch.vertices + static_cast<size_t>(batch.arity) * s, batch.arity, batch.residuals,
                             first, first_jacobian});
        first += batch.residuals;
        first_jacobian += static_cast<size_t>(batch.residuals) * 3 * batch.arity;
      }
    }
  }
  r_.resize(first);
  jacobian_.resize(first_jacobian);
}

bool ResidualModel::evaluate(bool with_jacobian) {
  for (size_t v = 0; v < squares_.views.size(); ++v)
    if (!squares_.views[v]->residuals(x_, r_.data() + view_start_[v].first,
                                      with_jacobian ? jacobian_.data() + view_start_[v].second : nullptr))
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
      multiply(jacobian_, view_start_[v].second, end ? jacobian_.size() : view_start_[v + 1].second, root);
  }
  return finite;
}

// M (q0 - target) = gradient - J^T r.
void ResidualModel::fold(const VecX& gradient) {
  evaluate(true);
  const DofMap& blocks = squares_.dofs;
  VecX rest = gradient, diagonal = VecX::Zero(blocks.block_count());
  for (const Stencil& s : stencils_) {
    using Rows = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
    const Eigen::Map<const Rows> jacobian(this->jacobian(s), s.residuals, 3 * s.arity);
    const Eigen::Map<const VecX> r(residuals(s), s.residuals);
    for (int i = 0; i < s.arity; ++i) {
      const int b = blocks.block(s.vertices[i]);
      if (b < 0) continue;
      rest.segment<3>(3 * b) -= jacobian.middleCols(3 * i, 3).transpose() * r;
      diagonal(b) += jacobian.middleCols(3 * i, 3).squaredNorm() / 3;
    }
  }
  const double largest = std::max(diagonal.maxCoeff(), 1e-300);
  root_mass_.resize(blocks.block_count());
  target_.resize(blocks.size());
  for (int b = 0; b < blocks.block_count(); ++b) {
    double mass = squares_.block_mass(b);
    if (mass == 0) mass = weak_pull * (diagonal(b) > 0 ? diagonal(b) : largest);
    root_mass_(b) = std::sqrt(mass);
    target_.segment<3>(3 * b) = vertex(x_, blocks.vertex_of_block(b)) - rest.segment<3>(3 * b) / mass;
  }
}

}  // namespace tack
