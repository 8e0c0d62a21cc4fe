#include "framework/core/damping_terms.hpp"

#include <numeric>

#include "framework/core/records.hpp"
#include "geometry/parallel.hpp"

namespace tack {

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

MassDamping::MassDamping(int first_vertex, int count, const VecX& mass, double alpha) : vertices_(count) {
  std::iota(vertices_.begin(), vertices_.end(), first_vertex);
  for (const int v : vertices_) drag_.push_back(alpha * mass(v));
}

double MassDamping::square(const VecX& x, Reference from) const {
  const VecX& reference = from == Reference::start ? start_ : velocity_.still;
  return sum_chunks(static_cast<int>(vertices_.size()), [&](int first, int last) {
    double sum = 0;
    for (int i = first; i < last; ++i) sum += drag_[i] * (vertex(x, vertices_[i]) - vertex(reference, vertices_[i])).squaredNorm();
    return sum;
  });
}

void MassDamping::derivatives(const VecX& x, Projection, double* gradient, double* hessian) const {
  for_each(static_cast<int>(vertices_.size()), [&](int i) {
    const double drag = begun() ? velocity_.rate * drag_[i] : 0;
    Eigen::Map<Vec3> force(gradient + 3 * static_cast<size_t>(i));
    if (begun()) force = drag * (vertex(x, vertices_[i]) - vertex(velocity_.still, vertices_[i]));
    else force.setZero();
    if (hessian) Eigen::Map<Mat3>(hessian + 9 * static_cast<size_t>(i)) = drag * Mat3::Identity();
  });
}

void MassDamping::add_mean_forces(const VecX& x, VecX& forces) const {
  for (size_t i = 0; i < vertices_.size(); ++i) vertex(forces, vertices_[i]) -= drag_[i] / h_ * (vertex(x, vertices_[i]) - vertex(start_, vertices_[i]));
}

}  // namespace tack
