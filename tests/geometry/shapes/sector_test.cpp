#include "geometry/shapes/sector.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <numbers>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

double volume(const Mesh& mesh) {
  double sum = 0;
  for (const Tet& t : mesh.tets) {
    const auto& x = mesh.vertices;
    const double v = (x[t[1]] - x[t[0]]).cross(x[t[2]] - x[t[0]]).dot(x[t[3]] - x[t[0]]) / 6;
    CHECK(v > 0);
    sum += v;
  }
  return sum;
}

}  // namespace

TEST_CASE("graded cells have the given lengths at the given positions") {
  const std::vector<double> places = graded({{0, 1}, {10, 1}, {110, 21}});
  REQUIRE(places.size() > 15);
  for (int i = 0; i <= 10; ++i) CHECK(places[i] == Approx(i).margin(1e-12));
  CHECK(places.back() == 110);
  CHECK(places[11] - places[10] == Approx(1).epsilon(0.15));
  CHECK(places.back() - places[places.size() - 2] == Approx(21).epsilon(0.15));
  for (size_t i = 11; i + 1 < places.size(); ++i) CHECK(places[i + 1] - places[i] > places[i] - places[i - 1]);
  CHECK(graded({{0, 3}, {10, 3}}).size() == 5);  // no longer than said
  CHECK_THROWS_AS(graded({{0, 1}}), InputError);
  CHECK_THROWS_AS(graded({{1, 1}, {2, 1}}), InputError);
  CHECK_THROWS_AS(graded({{0, 1}, {2, 0}}), InputError);
  CHECK_THROWS_AS(graded({{0, 1}, {2, 1}, {2, 1}}), InputError);
  CHECK_THROWS_AS(graded({{0, 1}, {1e9, 1}}), InputError);
}

TEST_CASE("a sector has the volume of its wedge, fits inside and is closed") {
  const double angle = 0.2;
  const Mesh flat = sector({angle, 0, graded({{0, 0.1}, {1, 0.3}}), graded({{0, 0.1}, {0.5, 0.2}})});
  CHECK(volume(flat) == Approx(std::sin(angle) / 2 * 0.5));
  const Mesh crowned = sector({angle, 2, graded({{0, 0.01}, {1, 0.01}}), graded({{0, 0.1}, {0.5, 0.2}})});
  // Volume of a cylinder minus the region beside a cap of height h.
  const double h = 2 - std::sqrt(3.0), cap = std::numbers::pi * h * (3 + h * h) / 6, cylinder = std::numbers::pi * 0.5;
  CHECK(volume(crowned) == Approx((cylinder - std::numbers::pi * h + cap) * std::sin(angle) / (2 * std::numbers::pi)).epsilon(1e-3));
  CHECK(crowned.tags.at("axis").size() == graded({{0, 0.1}, {0.5, 0.2}}).size());
  CHECK(crowned.tags.at("left").size() == crowned.tags.at("right").size());
  for (const int v : crowned.tags.at("right")) CHECK(-std::sin(angle / 2) * crowned.vertices[v].x() + std::cos(angle / 2) * crowned.vertices[v].z() == Approx(0).margin(1e-15));
  CHECK(crowned.vertices[crowned.tags.at("top").front()].norm() == 0);
  CHECK(crowned.vertices[crowned.tags.at("rim").front()].y() == Approx(-h));
  for (const int v : crowned.tags.at("bottom")) CHECK(crowned.vertices[v].y() == Approx(-0.5));
}

TEST_CASE("invalid sectors are refused") {
  const std::vector<double> one = {0, 1};
  CHECK_THROWS_AS(sector({0, 0, one, one}), InputError);
  CHECK_THROWS_AS(sector({2, 0, one, one}), InputError);
  CHECK_THROWS_AS(sector({0.1, 0.5, one, one}), InputError);
  CHECK_THROWS_AS(sector({0.1, 1.01, one, {0, 0.1}}), InputError);
  CHECK_THROWS_AS(sector({0.1, 0, {0}, one}), InputError);
}
