#include "framework/core/term_gradient.hpp"

namespace tack {

void add_term_gradient(const Term& term, const VecX& x, VecX& gradient) {
  term.add_linear_gradient(gradient);
  add_stencil_gradient(term, x, gradient);
}

void add_stencil_gradient(const Term& term, const VecX& x, VecX& gradient) {
  const auto batches = term.batches();
  size_t slots = 0;
  for (const StencilBatch& b : batches) slots += static_cast<size_t>(b.arity) * b.count;
  std::vector<double> gradients(3 * slots);
  term.derivatives(x, Projection::none, gradients.data(), nullptr);
  const double* slot = gradients.data();
  for (const StencilBatch& b : batches)
    for (int k = 0; k < b.arity * b.count; ++k, slot += 3)
      vertex(gradient, b.vertices[k]) += Eigen::Map<const Vec3>(slot);
}

}  // namespace tack
