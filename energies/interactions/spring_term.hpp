// Springs between pairs of vertices: sum_s k_s/2 (l_s - L_s)^2, l_s their lengths. A spring whose
// force at the end of a step exceeds its strength is broken from the next step on, permanently: a
// history variable.
#pragma once

#include <limits>

#include "framework/assembly/pair_spring.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

class SpringTerm : public Term, public ResidualView {
 public:
  // history: name of the array that marks broken springs.
  explicit SpringTerm(std::string history) : Term("springs"), history_(std::move(history)) {}

  struct Spring {
    double stiffness = 0;                                       // N/m
    double length = 0;                                          // m, at rest
    double strength = std::numeric_limits<double>::infinity();  // N
  };
  void add(Edge vertices, const Spring& spring);
  int count() const { return static_cast<int>(springs_.size()); }
  int intact() const;
  // Returns the sum of the forces on the first vertices [N].
  Vec3 force(const VecX& x) const;

  void load_history(const History& history) override;
  void commit(const VecX& x, History& history) const override;
  void publish(Records& records) const override;
  double dissipated(const VecX& x) const;  // by those that break [J]

  double value(const VecX& x) const override;
  std::vector<StencilBatch> batches() const override {
    return {{2, count(), vertices_.empty() ? nullptr : vertices_.front().data()}};
  }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override;

  const ResidualView* residual_view() const override { return this; }
  std::vector<ResidualBatch> residual_batches() const override {
    return {{2, 1, count(), vertices_.empty() ? nullptr : vertices_.front().data()}};
  }
  bool residuals(const VecX& x, double* r, double* jacobian) const override;

 private:
  Vec3 span(int s, const VecX& x) const {
    return vertex(x, vertices_[s][1]) - vertex(x, vertices_[s][0]);
  }
  PairSpring pair(int s) const {
    return {broken_[s] ? 0 : springs_[s].stiffness, springs_[s].length};
  }
  bool breaks(int s, const VecX& x) const;
  double energy(int s, const VecX& x) const;

  std::string history_;
  std::vector<Edge> vertices_;
  std::vector<Spring> springs_;
  std::vector<char> broken_;
};

}  // namespace tack
