#include "framework/assembly/psd_projection.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

MatX random_symmetric(int n, RandomMotions& random) {
  const MatX a = MatX::NullaryExpr(n, n, [&] { return random.uniform(-1, 1); });
  return a + a.transpose();
}

// Removes the components along translations of all vertices.
MatX translation_invariant(const MatX& a) {
  MatX projector = MatX::Identity(a.rows(), a.cols());
  const int k = static_cast<int>(a.rows()) / 3;
  for (int i = 0; i < k; ++i)
    for (int j = 0; j < k; ++j) projector.block(3 * i, 3 * j, 3, 3).diagonal().array() -= 1.0 / k;
  return projector * a * projector;
}

template <int N>
MatX plain(const MatX& a, Projection projection) {
  Eigen::Matrix<double, N, N> hessian = a;
  project_psd<N>(hessian, projection);
  return hessian;
}
template <int K>
MatX stencil(const MatX& a, Projection projection) {
  Eigen::Matrix<double, 3 * K, 3 * K> hessian = a;
  project_stencil_psd<K>(hessian, projection);
  return hessian;
}

using Project = MatX (*)(const MatX&, Projection);

void check_plain(int n, Project project) {
  RandomMotions random(n);
  for (int trial = 0; trial < 50; ++trial) {
    const MatX a = random_symmetric(n, random);
    for (const Projection projection : {Projection::none, Projection::clamp, Projection::absolute})
      CHECK((project(a, projection) - projected(a, projection)).norm() <= 1e-13 * a.norm());
    const MatX definite = a * a.transpose() + 1e-6 * MatX::Identity(n, n);
    CHECK(project(definite, Projection::clamp) == definite);  // untouched
  }
}

void check_stencil(int k, Project project) {
  RandomMotions random(10 + k);
  for (int trial = 0; trial < 50; ++trial) {
    const MatX a = translation_invariant(random_symmetric(3 * k, random));
    for (const Projection projection : {Projection::none, Projection::clamp, Projection::absolute}) {
      const MatX result = project(a, projection);
      CHECK((result - projected(a, projection)).norm() <= 1e-13 * a.norm());
      CHECK((translation_invariant(result) - result).norm() <= 1e-13 * a.norm());
    }
    const MatX definite = translation_invariant(a * a.transpose());
    CHECK((project(definite, Projection::absolute) - definite).norm() <= 1e-13 * definite.norm());
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
  check_stencil(7, stencil<7>);
  check_stencil(9, stencil<9>);
}

TEST_CASE("one eigenvalue under each policy", "[assembly]") {
  CHECK(projected(-2, Projection::none) == -2);
  CHECK(projected(-2, Projection::clamp) == 0);
  CHECK(projected(-2, Projection::absolute) == 2);
  for (const Projection f : {Projection::none, Projection::clamp, Projection::absolute}) CHECK(projected(3, f) == 3);
}
