// A toy potential with stencils of arity K: sum_s |u_s|^4 / 4, u_s = sum_i c_i x_i with sum c_i =
// 0.
#pragma once

#include <vector>

#include "framework/core/term.hpp"

namespace tack {

class PolynomialTerm : public Term, public StencilRanges {
 public:
  PolynomialTerm(int arity, std::vector<int> vertices, bool dynamic = false)
      : Term("polynomial"), arity_(arity), vertices_(std::move(vertices)), dynamic_(dynamic) {}

  PolynomialTerm& by_ranges() {
    by_ranges_ = true;
    return *this;
  }
  std::vector<const StencilRanges*> ranges() const override {
    return by_ranges_ ? std::vector<const StencilRanges*>{this}
                      : std::vector<const StencilRanges*>{};
  }
  void set_vertices(std::vector<int> vertices) { vertices_ = std::move(vertices); }
  const std::vector<int>& vertex_list() const { return vertices_; }
  int count() const { return static_cast<int>(vertices_.size()) / arity_; }
  bool dynamic() const override { return dynamic_; }
  std::vector<StencilBatch> batches() const override {
    return {{arity_, count(), vertices_.data()}};
  }

  double value(const VecX& x) const override {
    double sum = 0;
    for (int s = 0; s < count(); ++s) sum += std::pow(u(x, s).squaredNorm(), 2) / 4;
    return sum;
  }
  void derivatives(const VecX& x, Projection projection, double* gradient,
                   double* hessian) const override {
    range_derivatives(x, projection, 0, count(), gradient, hessian);
  }
  void range_derivatives(const VecX& x, Projection, int first, int last, double* gradient,
                         double* hessian) const override {
    for (int s = first; s < last; ++s) {
      const Vec3 us = u(x, s);
      const Mat3 h = us.squaredNorm() * Mat3::Identity() + 2 * us * us.transpose();
      for (int i = 0; i < arity_; ++i, gradient += 3)
        Eigen::Map<Vec3>{gradient} = coefficient(i) * us.squaredNorm() * us;
      if (!hessian) continue;
      for (int i = 0; i < arity_; ++i)
        for (int j = 0; j <= i; ++j, hessian += 9)
          Eigen::Map<Mat3>{hessian} = coefficient(i) * coefficient(j) * h;
    }
  }

 private:
  double coefficient(int i) const {
    return i + 1 < arity_ ? 1.0 + i : -arity_ * (arity_ - 1) / 2.0;
  }
  Vec3 u(const VecX& x, int s) const {
    Vec3 sum = Vec3::Zero();
    for (int i = 0; i < arity_; ++i) sum += coefficient(i) * vertex(x, vertices_[arity_ * s + i]);
    return sum;
  }

  int arity_;
  std::vector<int> vertices_;
  bool dynamic_;
  bool by_ranges_ = false;
};

}  // namespace tack
