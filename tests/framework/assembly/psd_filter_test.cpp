#include "framework/assembly/psd_filter.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

template <int N>
using Matrix = Eigen::Matrix<double, N, N>;

template <int N>
Matrix<N> random_symmetric(RandomMotions& random) {
  const Matrix<N> a = Matrix<N>::NullaryExpr([&] { return random.uniform(-1, 1); });
  return a + a.transpose();
}

// The projection by a full eigenvalue decomposition.
MatX reference(const MatX& a, SpdFilter filter) {
  const Eigen::SelfAdjointEigenSolver<MatX> eigen(a);
  const VecX values = eigen.eigenvalues().unaryExpr([&](double v) { return filtered(v, filter); });
  return eigen.eigenvectors() * values.asDiagonal() * eigen.eigenvectors().transpose();
}

// Removes what a translation of all K vertices would feel.
template <int K>
Matrix<3 * K> translation_invariant(const Matrix<3 * K>& a) {
  Matrix<3 * K> projector = Matrix<3 * K>::Identity();
  for (int i = 0; i < K; ++i)
    for (int j = 0; j < K; ++j) projector.template block<3, 3>(3 * i, 3 * j) -= Mat3::Identity() / K;
  return projector * a * projector;
}

template <int N>
void check_plain() {
  RandomMotions random(N);
  for (int trial = 0; trial < 50; ++trial) {
    const Matrix<N> a = random_symmetric<N>(random);
    for (const SpdFilter filter : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) {
      Matrix<N> projected = a;
      project_psd<N>(projected, filter);
      CHECK((projected - reference(a, filter)).norm() <= 1e-13 * a.norm());
    }
    Matrix<N> definite = a * a.transpose() + 1e-6 * Matrix<N>::Identity();
    const Matrix<N> before = definite;
    project_psd<N>(definite, SpdFilter::clamp);
    CHECK(definite == before);  // untouched
  }
}

template <int K>
void check_stencil() {
  RandomMotions random(10 + K);
  for (int trial = 0; trial < 50; ++trial) {
    const Matrix<3 * K> a = translation_invariant<K>(random_symmetric<3 * K>(random));
    for (const SpdFilter filter : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) {
      Matrix<3 * K> projected = a;
      project_stencil_psd<K>(projected, filter);
      CHECK((projected - reference(a, filter)).norm() <= 1e-13 * a.norm());
      CHECK((translation_invariant<K>(projected) - projected).norm() <= 1e-13 * a.norm());
    }
    Matrix<3 * K> definite = translation_invariant<K>(a * a.transpose());
    const Matrix<3 * K> before = definite;
    project_stencil_psd<K>(definite, SpdFilter::absolute);
    CHECK((definite - before).norm() <= 1e-13 * before.norm());
  }
}

}  // namespace

TEST_CASE("plain projections agree with the eigenvalue decomposition", "[assembly]") {
  check_plain<2>();
  check_plain<3>();
  check_plain<6>();
  check_plain<9>();
}

TEST_CASE("projections of stencils agree with it too and keep translations free", "[assembly]") {
  check_stencil<2>();
  check_stencil<3>();
  check_stencil<4>();
}

TEST_CASE("one eigenvalue under each policy", "[assembly]") {
  CHECK(filtered(-2, SpdFilter::none) == -2);
  CHECK(filtered(-2, SpdFilter::clamp) == 0);
  CHECK(filtered(-2, SpdFilter::absolute) == 2);
  for (const SpdFilter f : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) CHECK(filtered(3, f) == 3);
}
