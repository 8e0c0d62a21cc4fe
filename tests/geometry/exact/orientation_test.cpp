#include "geometry/exact/orientation.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

using namespace tack;

namespace {

// Vertices 0 .. 2 in a tilted plane that doubles represent exactly; vertex 3 in it, up to `height`.
VecX corner(double height) {
  VecX x(12);
  x << 0, 0, 0, /**/ 1, 0, 0.5, /**/ 0, 1, 0.25, /**/ 0.25, 0.5, 0.25 + height;
  return x;
}

}  // namespace

TEST_CASE("the sign of a volume is exact for nearly flat tets", "[orientation]") {
  const std::vector<Tet> up = {{0, 1, 2, 3}}, down = {{0, 2, 1, 3}};
  for (const double height : {1.0, 1e-14, std::ldexp(1.0, -54)}) {
    REQUIRE(first_inverted_tet(up, corner(height)) == -1);
    REQUIRE(first_inverted_tet(up, corner(-height)) == 0);
    REQUIRE(first_inverted_tet(down, corner(height)) == 0);
    REQUIRE(first_inverted_tet(down, corner(-height)) == -1);
  }
  REQUIRE(first_inverted_tet(up, corner(0.0)) == 0);  // flat is not positive
  REQUIRE(first_inverted_tet(down, corner(0.0)) == 0);
}

TEST_CASE("the lowest inverted tet is named, for any number of threads", "[orientation]") {
  std::vector<Tet> tets(20000, Tet{0, 1, 2, 3});
  REQUIRE(first_inverted_tet({}, VecX()) == -1);
  REQUIRE(first_inverted_tet(tets, corner(1.0)) == -1);
  for (const int bad : {19999, 7001, 5000}) {
    std::swap(tets[bad][0], tets[bad][1]);
    for (const std::size_t threads : {1, 2}) {
      tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
      REQUIRE(first_inverted_tet(tets, corner(1.0)) == bad);
    }
  }
}

TEST_CASE("a tet with a coordinate that is not finite counts as inverted", "[orientation]") {
  VecX x = corner(1.0);
  x[4] = std::numeric_limits<double>::quiet_NaN();
  REQUIRE(first_inverted_tet({{0, 1, 2, 3}}, x) == 0);
}

TEST_CASE("a point in a tet is found exactly, on its border too", "[orientation]") {
  VecX x(12);
  x << 0, 0, 0, /**/ 1, 0, 0, /**/ 0, 1, 0, /**/ 0, 0, 1;
  const Tet tet = {0, 1, 2, 3};
  const double tiny = std::ldexp(1.0, -60);
  REQUIRE(tet_contains(tet, x, {0.2, 0.2, 0.2}));
  REQUIRE(tet_contains(tet, x, {0, 0, 0}));
  REQUIRE(tet_contains(tet, x, {0.25, 0.25, 0}));
  REQUIRE(tet_contains(tet, x, {0.5, 0.25, 0.25}));
  REQUIRE_FALSE(tet_contains(tet, x, {0.25, 0.25, -tiny}));
  REQUIRE_FALSE(tet_contains(tet, x, {0.5, 0.25, std::nextafter(0.25, 1)}));
}
