#include "framework/assembly/listed_stencils.hpp"

#include <algorithm>

namespace tack {
namespace {

class ListedStencils : public Term {
 public:
  ListedStencils(const Term& whole, const StencilChoice& choice, const VecX& x)
      : Term(whole.name()), whole_(whole), x_(x), vertices_(choice.vertices.all()), chosen_(choice.stencils.begin(), choice.stencils.end()), local_(chosen_.size()) {
    batches_ = whole.batches();
    for (size_t b = 0; b < batches_.size(); ++b) {
      StencilBatch& batch = batches_[b];
      for (const int s : chosen_[b])
        for (int k = 0; k < batch.arity; ++k) local_[b].push_back(choice.vertices.find(batch.vertices[static_cast<size_t>(batch.arity) * s + k]));
      whole_counts_.push_back(batch.count);
      batch.count = static_cast<int>(chosen_[b].size());
      batch.vertices = local_[b].data();
    }
  }

  double value(const VecX&) const override { return whole_.value(x_); }
  std::vector<StencilBatch> batches() const override { return batches_; }
  bool dynamic() const override { return whole_.dynamic(); }
  bool stores() const override { return whole_.stores(); }

  void derivatives(const VecX&, Projection projection, double* gradient, double* hessian) const override {
    size_t gradients = 0, hessians = 0;
    for (size_t b = 0; b < batches_.size(); ++b) {
      gradients += 3 * static_cast<size_t>(batches_[b].arity) * whole_counts_[b];
      hessians += 9 * static_cast<size_t>(hessian_blocks(batches_[b].arity)) * whole_counts_[b];
    }
    std::vector<double> g(gradients), h(hessian ? hessians : 0);
    whole_.derivatives(x_, projection, g.data(), hessian ? h.data() : nullptr);
    const double *from_g = g.data(), *from_h = h.data();
    for (size_t b = 0; b < batches_.size(); ++b) {
      const size_t n = 3 * static_cast<size_t>(batches_[b].arity), m = 9 * static_cast<size_t>(hessian_blocks(batches_[b].arity));
      for (const int s : chosen_[b]) {
        gradient = std::copy_n(from_g + n * s, n, gradient);
        if (hessian) hessian = std::copy_n(from_h + m * s, m, hessian);
      }
      from_g += n * whole_counts_[b];
      if (hessian) from_h += m * whole_counts_[b];
    }
  }

  void add_linear_gradient(VecX& gradient) const override {
    VecX full = VecX::Zero(x_.size());
    whole_.add_linear_gradient(full);
    for (size_t i = 0; i < vertices_.size(); ++i) vertex(gradient, static_cast<int>(i)) += vertex(full, vertices_[i]);
  }

 protected:
  VecX local_of(const VecX& full) const {
    VecX own(3 * vertices_.size());
    for (size_t i = 0; i < vertices_.size(); ++i) vertex(own, static_cast<int>(i)) = vertex(full, vertices_[i]);
    return own;
  }
  const Term& whole_;
  const VecX& x_;

 private:
  std::vector<int> vertices_;              // global, by local vertex
  std::vector<std::vector<int>> chosen_;   // stencils of each batch
  std::vector<std::vector<int>> local_;    // their local vertices
  std::vector<StencilBatch> batches_;
  std::vector<int> whole_counts_;  // stencils of each batch of the whole term
};

class ListedModes : public ListedStencils, public GlobalModeSource {
 public:
  using ListedStencils::ListedStencils;
  void add_global_modes(const VecX&, Projection projection, GlobalModes& modes) const override {
    GlobalModes full;
    dynamic_cast<const GlobalModeSource&>(whole_).add_global_modes(x_, projection, full);
    for (const GlobalMode& mode : full) modes.push_back({mode.coefficient, local_of(mode.vector)});
  }
};

}  // namespace

std::unique_ptr<Term> listed_stencils(const Term& whole, const StencilChoice& choice, const VecX& x) {
  if (dynamic_cast<const GlobalModeSource*>(&whole)) return std::make_unique<ListedModes>(whole, choice, x);
  return std::make_unique<ListedStencils>(whole, choice, x);
}

}  // namespace tack
