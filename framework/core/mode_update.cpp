#include "framework/core/mode_update.hpp"

#include <Eigen/Eigenvalues>
#include <Eigen/LU>
#include <algorithm>

namespace tack {

void ModeUpdate::clear() {
  columns_.clear();
  solved_.clear();
  coefficients_.clear();
}

void ModeUpdate::add(const GlobalMode& mode, const VecX& solved) {
  columns_.push_back(mode.vector);
  solved_.push_back(solved);
  coefficients_.push_back(mode.coefficient);
}

bool ModeUpdate::finish() {
  const auto count = static_cast<Eigen::Index>(columns_.size());
  inner_.resize(count, count);
  for (Eigen::Index i = 0; i < count; ++i)
    for (Eigen::Index j = 0; j <= i; ++j)
      inner_(i, j) = inner_(j, i) = (columns_[i].dot(solved_[j]) + columns_[j].dot(solved_[i])) / 2 + (i == j ? 1 / coefficients_[i] : 0.0);
  if (count == 0) return true;
  inverse_ = inner_.inverse();
  return inverse_.allFinite();
}

bool ModeUpdate::definite() const {
  if (columns_.empty()) return true;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(inner_, Eigen::EigenvaluesOnly);
  const auto negative = std::count_if(coefficients_.begin(), coefficients_.end(), [](double c) { return c < 0; });
  return (eigen.eigenvalues().array() < 0).count() == negative;
}

void ModeUpdate::apply(VecX& x) const {
  const auto count = static_cast<Eigen::Index>(columns_.size());
  if (count == 0) return;
  VecX along(count);
  for (Eigen::Index k = 0; k < count; ++k) along(k) = columns_[k].dot(x);
  const VecX amount = inverse_ * along;
  for (Eigen::Index k = 0; k < count; ++k) x -= amount(k) * solved_[k];
}

}  // namespace tack
