#include "framework/core/damping_terms.hpp"

#include <fmt/format.h>

#include <catch2/catch.hpp>
#include <numeric>

using namespace tack;

namespace {

// One stencil of a number of vertices. Its Hessian has i + j + 1 everywhere in the block of its vertices i and j.
class Wide : public Term {
 public:
  explicit Wide(int arity) : Term("wide"), vertices_(arity) { std::iota(vertices_.begin(), vertices_.end(), 0); }
  double value(const VecX&) const override { return 0; }
  std::vector<StencilBatch> batches() const override { return {{static_cast<int>(vertices_.size()), 1, vertices_.data()}}; }
  void derivatives(const VecX&, Projection, double* gradient, double* hessian) const override {
    const int arity = static_cast<int>(vertices_.size());
    std::fill(gradient, gradient + 3 * arity, 0.0);
    for (int i = 0; hessian && i < arity; ++i)
      for (int j = 0; j <= i; ++j, hessian += 9) std::fill(hessian, hessian + 9, i + j + 1.0);
  }

 private:
  std::vector<int> vertices_;
};

}  // namespace

TEST_CASE("stiffness damping: stencils of the largest arity") {
  const int n = largest_arity;
  const Wide wide(n);
  const double beta = 0.1, h = 0.01;
  const auto owned = stiffness_damping(wide, beta);
  DampingTerm& damping = *owned;
  const VecX start = VecX::Zero(3 * n);
  VecX end(3 * n);
  for (int i = 0; i < n; ++i) end.segment<3>(3 * i).setConstant(i + 1.0);
  damping.begin_step({start, 0, h});
  double square = 0;  // end^T K end
  std::vector<double> force(n, 0.0);
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      square += 9 * (i + 1.0) * (i + j + 1.0) * (j + 1.0);
      force[i] -= beta / h * 3 * (i + j + 1.0) * (j + 1.0);
    }
  CHECK(damping.value(end) == Approx(beta * square / (2 * h)));
  CHECK(damping.dissipated(end) == Approx(beta * square / h));
  VecX forces = VecX::Zero(3 * n), gradient(3 * n), hessian(9 * hessian_blocks(n));
  damping.add_mean_forces(end, forces);
  damping.derivatives(end, Projection::none, gradient.data(), hessian.data());
  for (int i = 0; i < n; ++i) {
    CHECK(forces(3 * i) == Approx(force[i]));
    CHECK(gradient(3 * i + 2) == Approx(-force[i]));
  }
}

TEST_CASE("stiffness damping: stencils of more vertices are refused") {
  const Wide wide(largest_arity + 1);
  CHECK_THROWS_WITH(stiffness_damping(wide, 0.1), Catch::Contains(fmt::format("stencils of {} vertices, and {} are the most", largest_arity + 1, largest_arity)));
}
