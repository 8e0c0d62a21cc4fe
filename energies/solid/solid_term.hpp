// sum over tets of volume * psi(F), for an isotropic material given in principal stretches.
// A material has
//   double energy(const Mat3& f) const;                           psi [J/m^3]
//   PrincipalDerivatives derivatives(const Vec3& stretches) const;
//   RootSample stretch_root(double s) const, volume_root(double j) const;   see solid_residuals.hpp
// The Hessian is filtered in the principal frame, in closed form but for one 3x3 matrix.
#pragma once

#include <algorithm>
#include <atomic>

#include "energies/solid/principal.hpp"
#include "energies/solid/solid_residuals.hpp"
#include "energies/solid/svd3_batch.hpp"
#include "energies/solid/tet_geometry.hpp"
#include "framework/assembly/parallel.hpp"
#include "framework/core/residual_view.hpp"
#include "framework/core/term.hpp"

namespace tack {

template <class Material>
class SolidTerm : public Term, public ResidualView {
 public:
  SolidTerm(std::string name, const Material& material, const Body& body, const VecX& rest)
      : Term(std::move(name)), material_(material), tets_(body.tets), rest_(tet_rest_data(body, rest)) {}

  double value(const VecX& x) const override {
    return sum_chunks(count(), [&](int first, int last) {
      double sum = 0;
      for (int t = first; t < last; ++t)
        sum += rest_[t].volume * material_.energy(deformation_gradient(rest_[t], tets_[t], x));
      return sum;
    });
  }

  std::vector<StencilBatch> batches() const override {
    return {{4, count(), tets_.empty() ? nullptr : tets_.front().data()}};
  }

  void derivatives(const VecX& x, SpdFilter filter, double* gradient,
                   double* hessian) const override {
    for_each_chunk(count(), [&](int, int first, int last) {
      for (int t = first; t < last; t += lanes)
        elements(t, std::min(t + lanes, last), x, filter, gradient, hessian);
    });
  }

  // A negative lambda is no sum of squares.
  const ResidualView* residual_view() const override { return material_.lame.lambda >= 0 ? this : nullptr; }

  std::vector<ResidualBatch> residual_batches() const override {
    return {{4, tet_residual_count, count(), tets_.empty() ? nullptr : tets_.front().data()}};
  }

  bool residuals(const VecX& x, double* r, double* jacobian) const override {
    std::atomic<bool> finite = true;
    for_each(count(), [&](int t) {
      const size_t at = static_cast<size_t>(t) * tet_residual_count;
      if (!tet_residuals(material_, rest_[t], deformation_gradient(rest_[t], tets_[t], x), r + at,
                         jacobian ? jacobian + 12 * at : nullptr))
        finite = false;
    });
    return finite;
  }

 private:
  static constexpr int lanes = 8;  // tets whose decompositions are computed side by side

  int count() const { return static_cast<int>(tets_.size()); }

  void elements(int first, int last, const VecX& x, SpdFilter filter, double* gradient,
                double* hessian) const {
    Svd3Batch<lanes> svd;
    for (int l = 0; l < lanes; ++l) {
      const int t = std::min(first + l, last - 1);
      svd.set(l, deformation_gradient(rest_[t], tets_[t], x));
    }
    svd.decompose();
    for (int t = first; t < last; ++t) {
      const size_t at = static_cast<size_t>(t);
      element(rest_[t], svd.get(t - first), filter, gradient + 12 * at,
              hessian ? hessian + 90 * at : nullptr);
    }
  }

  void element(const TetRest& rest, const Svd3& svd, SpdFilter filter, double* gradient,
               double* hessian) const {
    const PrincipalDerivatives d = material_.derivatives(svd.s);
    const Mat3 shape = rest.shape * svd.v;  // row a-1: V^T grad N_a
    Eigen::Map<Eigen::Matrix<double, 3, 4>> g(gradient);
    for (int a = 0; a < 3; ++a)
      g.col(a + 1) = rest.volume * (svd.u * d.gradient.cwiseProduct(shape.row(a).transpose()));
    g.col(0) = -(g.col(1) + g.col(2) + g.col(3));
    if (hessian) blocks(svd.u, shape, principal_hessian(svd.s, d, filter), rest.volume, hessian);
  }

  // K_ab = volume U K^_ab U^T for a, b = 1..3; the rows and columns of vertex 0 make sums vanish.
  static void blocks(const Mat3& u, const Mat3& shape, const PrincipalHessian& h, double volume,
                     double* out) {
    const auto slot = [&](int k) { return Eigen::Map<Mat3>(out + 9 * k); };
    constexpr int lower[3][3] = {{2, -1, -1}, {4, 5, -1}, {7, 8, 9}};
    for (int a = 0; a < 3; ++a)
      for (int b = 0; b <= a; ++b)
        slot(lower[a][b]).noalias() = u * local_block(shape.row(a), shape.row(b), h, volume) * u.transpose();
    slot(1) = -(slot(2) + slot(4).transpose() + slot(7).transpose());
    slot(3) = -(slot(4) + slot(5) + slot(8).transpose());
    slot(6) = -(slot(7) + slot(8) + slot(9));
    slot(0) = -(slot(1) + slot(3) + slot(6));
  }

  static Mat3 local_block(const Eigen::RowVector3d& p, const Eigen::RowVector3d& q,
                          const PrincipalHessian& h, double volume) {
    Mat3 k;
    for (int i = 0; i < 3; ++i) {
      for (int j = 0; j < 3; ++j) {
        if (i == j) continue;
        k(i, j) = volume * (h.diagonal(i, j) * p(i) * q(j) + h.cross(i, j) * p(j) * q(i));
      }
      double sum = h.diagonal(i, i) * p(i) * q(i);
      for (int j = 0; j < 3; ++j) sum += h.same(i, j) * p(j) * q(j);
      k(i, i) = volume * sum;
    }
    return k;
  }

  Material material_;
  std::vector<Tet> tets_;
  std::vector<TetRest> rest_;
};

}  // namespace tack
