#include "framework/assembly/pack_projection.hpp"

#include <catch2/catch.hpp>

#include "tests/support/dense_term.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// Matrices with every kind of spectrum, one for each lane.
template <int N>
Eigen::Matrix<double, N, N> sample(int kind, RandomMotions& random) {
  using Matrix = Eigen::Matrix<double, N, N>;
  const Matrix a = Matrix::NullaryExpr([&](auto...) { return random.uniform(-1, 1); });
  const Matrix q = a.householderQr().householderQ();
  Eigen::Matrix<double, N, 1> values = Eigen::Matrix<double, N, 1>::NullaryExpr([&](auto) { return random.uniform(-1, 1); });
  switch (kind) {
    case 0: return a + a.transpose();
    case 1: return Matrix::Zero();
    case 2: return values.asDiagonal();
    case 3: return a.col(0) * a.col(0).transpose() - 1e-3 * a.col(1) * a.col(1).transpose();  // rank 2
    case 4: values.setConstant(-0.7), values(0) = 0.7; break;  // one of many
    case 5: for (int i = 0; i < N; ++i) values(i) = (i % 2 ? -1 : 1) * std::pow(10, -3 * i); break;  // graded
    case 6: return 1e120 * Matrix(a * a.transpose());  // definite and large
    default: return 1e-120 * Matrix(a + a.transpose());
  }
  const Matrix graded = q * values.asDiagonal() * q.transpose();
  return (graded + graded.transpose()) / 2;
}

template <int N>
void check() {
  RandomMotions random(N);
  for (int trial = 0; trial < 50; ++trial) {
    for (const Projection projection : {Projection::none, Projection::clamp, Projection::absolute}) {
      for (int first = 0; first < 8; first += pack_width) {
        std::array<Eigen::Matrix<double, N, N>, pack_width> given;
        PackMatrix<N, N> pack;
        for (int l = 0; l < pack_width; ++l) set_lane<N, N>(pack, l, given[l] = sample<N>(first + l, random));
        project_psd<N>(pack, projection);
        for (int l = 0; l < pack_width; ++l) {
          const Eigen::Matrix<double, N, N> fast = get_lane<N, N>(pack, l);
          INFO("kind " << first + l);
          REQUIRE((fast - projected(given[l], projection)).norm() <= 2e-14 * given[l].norm());
          if (projection != Projection::none) REQUIRE(fast == fast.transpose());
          // alone as among others
          PackMatrix<N, N> alone;
          for (int k = 0; k < pack_width; ++k) set_lane<N, N>(alone, k, given[l]);
          project_psd<N>(alone, projection);
          REQUIRE(get_lane<N, N>(alone, l) == fast);
        }
      }
    }
  }
}

}  // namespace

TEST_CASE("projections side by side agree with the eigenvalue decomposition", "[assembly]") {
  check<3>();
  check<5>();
  check<9>();
}

TEST_CASE("projections side by side keep values that are not finite, in their lane alone", "[assembly]") {
  PackMatrix<3, 3> pack;
  const double infinity = std::numeric_limits<double>::infinity();
  for (const double bad : {std::numeric_limits<double>::quiet_NaN(), infinity, -infinity}) {
    for (int entry = 0; entry < 9; ++entry) {
      for (int l = 0; l < pack_width; ++l) set_lane<3, 3>(pack, l, Mat3(-Mat3::Identity()));
      pack(entry).set(1, bad);
      pack(entry % 3, entry / 3).set(1, bad);
      project_psd<3>(pack, Projection::clamp);
      CHECK(!get_lane<3, 3>(pack, 1).allFinite());
      CHECK(get_lane<3, 3>(pack, 0).norm() == 0);
    }
  }
}
