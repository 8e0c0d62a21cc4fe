#include "framework/assembly/psd_filter.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

MatX random_symmetric(int n, RandomMotions& random) {
  const MatX a = MatX::NullaryExpr(n, n, [&] { return random.uniform(-1, 1); });
  return a + a.transpose();
}

// Removes what a translation of all vertices would feel.
MatX translation_invariant(const MatX& a) {
  MatX projector = MatX::Identity(a.rows(), a.cols());
  const int k = static_cast<int>(a.rows()) / 3;
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) projector.block(3 * i, 3 * j, 3, 3).diagonal().array() -= 1.0 / k;
  return projector * a * projector;
}

template <int N>
MatX plain(const MatX& a, SpdFilter filter) {
  Eigen::Matrix<double, N, N> hessian = a;
  project_psd<N>(hessian, filter);
  return hessian;
}
template <int K>
MatX stencil(const MatX& a, SpdFilter filter) {
  Eigen::Matrix<double, 3 * K, 3 * K> hessian = a;
  project_stencil_psd<K>(hessian, filter);
  return hessian;
}

using Projection = MatX (*)(const MatX&, SpdFilter);

void check_plain(int n, Projection project) {
  RandomMotions random(n);
  for (int trial = 0; trial < 50; ++trial) {
    const MatX a = random_symmetric(n, random);
    for (const SpdFilter filter : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute})
      CHECK((project(a, filter) - projected(a, filter)).norm() <= 1e-13 * a.norm());
    const MatX definite = a * a.transpose() + 1e-6 * MatX::Identity(n, n);
    CHECK(project(definite, SpdFilter::clamp) == definite);  // untouched
  }
}

void check_stencil(int k, Projection project) {
  RandomMotions random(10 + k);
  for (int trial = 0; trial < 50; ++trial) {
    const MatX a = translation_invariant(random_symmetric(3 * k, random));
    for (const SpdFilter filter : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) {
      const MatX filtered = project(a, filter);
      CHECK((filtered - projected(a, filter)).norm() <= 1e-13 * a.norm());
      CHECK((translation_invariant(filtered) - filtered).norm() <= 1e-13 * a.norm());
    }
    const MatX definite = translation_invariant(a * a.transpose());
    CHECK((project(definite, SpdFilter::absolute) - definite).norm() <= 1e-13 * definite.norm());
  }
}

}  // namespace

TEST_CASE("plain projections agree with the eigenvalue decomposition", "[assembly]") {
  check_plain(2, plain<2>);
  check_plain(3, plain<3>);
  check_plain(6, plain<6>);
  check_plain(9, plain<9>);
}

TEST_CASE("projections of stencils agree with it too and keep translations free", "[assembly]") {
  check_stencil(2, stencil<2>);
  check_stencil(3, stencil<3>);
  check_stencil(4, stencil<4>);
}

TEST_CASE("one eigenvalue under each policy", "[assembly]") {
  CHECK(filtered(-2, SpdFilter::none) == -2);
  CHECK(filtered(-2, SpdFilter::clamp) == 0);
  CHECK(filtered(-2, SpdFilter::absolute) == 2);
  for (const SpdFilter f : {SpdFilter::none, SpdFilter::clamp, SpdFilter::absolute}) CHECK(filtered(3, f) == 3);
}
