// Stretching of edges: sum_e E A / (2 L) (|x_b - x_a| - L)^2.
#pragma once

#include "energies/rod/edges.hpp"
#include "framework/assembly/pair_spring.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"
#include "geometry/parallel.hpp"

namespace tack {

class EdgeStretching {
 public:
  // stretching: E A [N].
  EdgeStretching(std::vector<Edge> edges, double stretching, const VecX& rest)
      : edges_(std::move(edges)) {
    for (const Edge& e : edges_)
      springs_.push_back({stretching / edge_length(e, rest), edge_length(e, rest)});
  }

  const std::vector<Edge>& edges() const { return edges_; }
  int count() const { return static_cast<int>(edges_.size()); }
  StencilBatch batch() const {
    return {2, count(), edges_.empty() ? nullptr : edges_.front().data()};
  }

  // lengths: of each edge, instead of those at rest; null: those.
  double value(const VecX& x, const double* lengths = nullptr) const {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int e = first; e < last; ++e) sum += spring(e, lengths).energy(span(e, x));
      return sum;
    });
  }
  void derivatives(const VecX& x, Projection projection, double* gradient, double* hessian,
                   const double* lengths = nullptr) const {
    for_each(count(), [&](int e) {
      spring(e, lengths)
          .derivatives(span(e, x), projection, gradient + 6 * static_cast<size_t>(e),
                       hessian ? hessian + 27 * static_cast<size_t>(e) : nullptr);
    });
  }
  void lengths(const VecX& x, double* out) const {
    for (int e = 0; e < count(); ++e) out[e] = span(e, x).norm();
  }
  // Lengths at rest, which springs of branches change (strain_spring.hpp).
  void rest_lengths(double* out) const {
    for (int e = 0; e < count(); ++e) out[e] = springs_[e].length;
  }
  void set_rest_lengths(const double* lengths) {
    for (int e = 0; e < count(); ++e) springs_[e].length = lengths[e];
  }
  // Returns the energy of changes of the lengths [J].
  double energy_of(const double* changes) const {
    double sum = 0;
    for (int e = 0; e < count(); ++e) sum += springs_[e].stiffness / 2 * changes[e] * changes[e];
    return sum;
  }
  // See ResidualView: one for each edge.
  ResidualBatch residual_batch() const { return {2, 1, count(), batch().vertices}; }
  void residuals(const VecX& x, double* r, double* jacobian) const {
    for (int e = 0; e < count(); ++e)
      r[e] = springs_[e].residual(span(e, x),
                                  jacobian ? jacobian + 6 * static_cast<size_t>(e) : nullptr);
  }

 private:
  PairSpring spring(int e, const double* lengths) const {
    return lengths ? PairSpring{springs_[e].stiffness, lengths[e]} : springs_[e];
  }
  Vec3 span(int e, const VecX& x) const {
    return vertex(x, edges_[e][1]) - vertex(x, edges_[e][0]);
  }

  std::vector<Edge> edges_;
  std::vector<PairSpring> springs_;
};

}  // namespace tack
