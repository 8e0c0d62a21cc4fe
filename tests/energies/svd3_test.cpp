#include "energies/solid/svd3.hpp"

#include <Eigen/LU>
#include <catch2/catch.hpp>

#include "geometry/types.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// Stretches from 1e-6 to 1e3, equal ones among them; det F > 0.
Mat3 sample(int kind, RandomMotions& random) {
  const Vec3 stretches[] = {{1, 1, 1},    {1, 1, 1 + 1e-12}, {2, 0.5, 0.5},    {1e-6, 1, 1e3},
                            {3, 1e-4, 1}, {0.7, 0.8, 0.9},   {1e-5, 1e-5, 1e-5}, {1e3, 1e3, 1e-6}};
  const Vec3 s = stretches[kind % 8];
  if (kind < 8) return s.asDiagonal();
  return random.rotation() * s.asDiagonal() * random.rotation().transpose();
}

template <class Check>
void for_each_matrix(const Check& check) {
  RandomMotions random(2);
  for (int trial = 0; trial < 100; ++trial)
    for (int first = 0; first < 16; first += pack_width) {
      std::array<Mat3, pack_width> f;
      for (int l = 0; l < pack_width; ++l) f[l] = sample(first + l, random);
      check(f);
    }
}

PackMat3 packed(const std::array<Mat3, pack_width>& f) {
  PackMat3 pack;
  for (int l = 0; l < pack_width; ++l) set_lane<3, 3>(pack, l, f[l]);
  return pack;
}

}  // namespace

TEST_CASE("singular values: rotations and stretches reproduce the matrix", "[solids]") {
  for_each_matrix([](const std::array<Mat3, pack_width>& given) {
    const Svd3<Pack> svd = svd3(packed(given));
    for (int l = 0; l < pack_width; ++l) {
      const Mat3 u = get_lane<3, 3>(svd.u, l), v = get_lane<3, 3>(svd.v, l);
      const Vec3 s = get_lane<3, 1>(svd.s, l);
      REQUIRE((u * s.asDiagonal() * v.transpose() - given[l]).norm() <= 2e-15 * given[l].norm());
      REQUIRE((u.transpose() * u - Mat3::Identity()).norm() <= 1e-9);  // that of a stretch of 1e-6 beside 1e3
      REQUIRE((v.transpose() * v - Mat3::Identity()).norm() <= 5e-15);
      REQUIRE(v.determinant() == Approx(1));
      REQUIRE(std::abs(s.prod() - given[l].determinant()) <= 1e-15 * std::pow(given[l].norm(), 3));
      const Svd3<double> alone = svd3(given[l]);
      REQUIRE((alone.s - s).norm() <= 2e-15 * s.norm());
    }
  });
}

TEST_CASE("singular values of a matrix do not depend on the other lanes", "[solids]") {
  for_each_matrix([](const std::array<Mat3, pack_width>& given) {
    const Svd3<Pack> together = svd3(packed(given));
    for (int l = 0; l < pack_width; ++l) {
      std::array<Mat3, pack_width> same;
      same.fill(given[l]);
      const Svd3<Pack> alone = svd3(packed(same));
      REQUIRE(get_lane<3, 3>(alone.u, l) == get_lane<3, 3>(together.u, l));
      REQUIRE(get_lane<3, 3>(alone.v, l) == get_lane<3, 3>(together.v, l));
      REQUIRE(get_lane<3, 1>(alone.s, l) == get_lane<3, 1>(together.s, l));
    }
  });
}
