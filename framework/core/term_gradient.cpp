#include "framework/core/term_gradient.hpp"

namespace tack {

void add_term_gradient(const Term& term, const VecX& x, VecX& gradient) {
  term.add_linear_gradient(gradient);
  add_stencil_gradient(term, x, gradient);
}

void add_stencil_gradient(const Term& term, const VecX& x, VecX& gradient, const std::function<bool(std::span<const int>)>& counts) {
  const auto batches = term.batches();
  size_t slots = 0;
  for (const StencilBatch& b : batches) slots += static_cast<size_t>(b.arity) * b.count;
  std::vector<double> gradients(3 * slots);
  term.derivatives(x, Projection::none, gradients.data(), nullptr);
  const double* slot = gradients.data();
  for (const StencilBatch& b : batches)
    for (int s = 0; s < b.count; ++s, slot += 3 * static_cast<size_t>(b.arity)) {
      const std::span<const int> vertices(b.vertices + static_cast<size_t>(b.arity) * s, b.arity);
      if (counts && !counts(vertices)) continue;
      for (int i = 0; i < b.arity; ++i) vertex(gradient, vertices[i]) += Eigen::Map<const Vec3>(slot + 3 * i);
    }
}

}  // namespace tack
