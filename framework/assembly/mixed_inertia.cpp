#include "framework/assembly/mixed_inertia.hpp"

#include <cmath>

namespace tack {

MixedInertia::MixedInertia(const VecX& mass, const DofMap& dofs) : Term("inertia") {
  for (const int v : dofs.dependents())
    if (dofs.mixed(v) && mass(v) > 0) vertices_.push_back(v);
  set_mass(mass);
}

void MixedInertia::set_mass(const VecX& mass) {
  mass_.resize(static_cast<Eigen::Index>(vertices_.size()));
  for (size_t i = 0; i < vertices_.size(); ++i) mass_(static_cast<Eigen::Index>(i)) = mass(vertices_[i]);
}

void MixedInertia::set_prediction(const VecX& prediction, double scale, bool inertia) {
  prediction_.resize(3 * mass_.size());
  for (size_t i = 0; i < vertices_.size(); ++i) vertex(prediction_, static_cast<int>(i)) = vertex(prediction, vertices_[i]);
  factor_ = inertia ? 1 / scale : 0;
}

double MixedInertia::value(const VecX& x) const {
  double sum = 0;
  for (int i = 0; i < static_cast<int>(vertices_.size()); ++i)
    sum += mass_(i) * (vertex(x, vertices_[i]) - vertex(prediction_, i)).squaredNorm();
  return 0.5 * factor_ * sum;
}

std::vector<StencilBatch> MixedInertia::batches() const {
  return {{1, static_cast<int>(vertices_.size()), vertices_.data()}};
}

void MixedInertia::derivatives(const VecX& x, Projection, double* gradient, double* hessian) const {
  for (int i = 0; i < static_cast<int>(vertices_.size()); ++i) {
    const double mass = factor_ * mass_(i);
    Eigen::Map<Vec3>{gradient + 3 * static_cast<size_t>(i)} = mass * (vertex(x, vertices_[i]) - vertex(prediction_, i));
    if (hessian) Eigen::Map<Mat3>{hessian + 9 * static_cast<size_t>(i)} = mass * Mat3::Identity();
  }
}

std::vector<ResidualBatch> MixedInertia::residual_batches() const {
  return {{1, 3, static_cast<int>(vertices_.size()), vertices_.data()}};
}

bool MixedInertia::residuals(const VecX& x, double* r, double* jacobian) const {
  for (int i = 0; i < static_cast<int>(vertices_.size()); ++i) {
    const double root = std::sqrt(factor_ * mass_(i));
    Eigen::Map<Vec3>{r + 3 * static_cast<size_t>(i)} = root * (vertex(x, vertices_[i]) - vertex(prediction_, i));
    if (jacobian) Eigen::Map<Mat3>{jacobian + 9 * static_cast<size_t>(i)} = root * Mat3::Identity();
  }
  return true;
}

}  // namespace tack
