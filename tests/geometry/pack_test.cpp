#include "geometry/pack_exp.hpp"

#include <catch2/catch.hpp>
#include <limits>
#include <vector>

using namespace tack;

namespace {
Pack ramp(double start) {
  Pack p;
  for (int l = 0; l < pack_width; ++l) p.set(l, start + l);
  return p;
}
}  // namespace

TEST_CASE("packs compute every lane independently", "[geometry]") {
  const Pack a = ramp(-1.5), b = ramp(2);
  for (int l = 0; l < pack_width; ++l) {
    const double x = l - 1.5, y = l + 2;
    CHECK((a * b + 3 - a / b)[l] == Approx(x * y + 3 - x / y));
    CHECK(abs(a)[l] == std::abs(x));
    CHECK(sqrt(b)[l] == std::sqrt(y));
    CHECK(log(b)[l] == std::log(y));
    CHECK(log1p(b)[l] == std::log1p(y));
    CHECK(select(a > 0, a, b)[l] == (x > 0 ? x : y));
    CHECK(select(a < 0, a, b)[l] == (x < 0 ? x : y));
  }
  CHECK(any(a < -1));
  CHECK(!any(a < -1.5));
  Pack nan = a;
  nan.set(1, std::numeric_limits<double>::quiet_NaN());
  CHECK(select(nan < 0, Pack(1), Pack(2))[1] == 2);
}

TEST_CASE("atan2 of lanes agrees with the standard library", "[geometry]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for (const double length : {1e-150, 1.0, 1e150})
    for (int i = -720; i < 720; i += pack_width) {
      Pack x, y;
      for (int l = 0; l < pack_width; ++l) {
        const double angle = (i + l) * M_PI / 720;
        x.set(l, length * std::cos(angle));
        y.set(l, length * std::sin(angle));
      }
      const Pack found = atan2(y, x);
      for (int l = 0; l < pack_width; ++l) {
        const double expected = std::atan2(y[l], x[l]);
        REQUIRE(std::abs(found[l] - expected) <= 4 * std::numeric_limits<double>::epsilon() * std::abs(expected));
      }
    }
  const auto lane = [](double y, double x) { return atan2(Pack(y), Pack(x))[0]; };
  CHECK(lane(0, 0) == 0);
  CHECK(lane(0, -1) == M_PI);
  CHECK(lane(1, 0) == M_PI / 2);
  CHECK(lane(-1, 0) == -M_PI / 2);
  CHECK(std::isnan(lane(nan, 1)));
  CHECK(std::isnan(lane(1, nan)));
}

TEST_CASE("exp of lanes agrees with the standard library", "[geometry]") {
  for (int i = -70800; i <= 70900; i += pack_width) {
    Pack x;
    for (int l = 0; l < pack_width; ++l) x.set(l, std::min(0.01 * (i + l) + 1e-5 * l, 709.0));
    const Pack found = exp(x);
    for (int l = 0; l < pack_width; ++l) REQUIRE(std::abs(found[l] / std::exp(x[l]) - 1) <= 3 * std::numeric_limits<double>::epsilon());
  }
  const auto lane = [](double x) { return exp(Pack(x))[0]; };
  const double infinite = std::numeric_limits<double>::infinity();
  CHECK(lane(0) == 1);
  for (const double tiny : {1e-300, 1e-17, -1e-17, 1e-9}) CHECK(lane(tiny) == std::exp(tiny));
  CHECK(lane(-infinite) == Approx(std::exp(-708.0)));
  CHECK(lane(infinite) == Approx(std::exp(709.0)));
  CHECK(lane(std::numeric_limits<double>::quiet_NaN()) == lane(-708));
}

TEST_CASE("packs are stored lane by lane, for any number of lanes", "[geometry]") {
  for (const int count : {1, 3, 6, 8, 9, 12, 27, 90}) {
    std::vector<Pack> packs;
    for (int i = 0; i < count; ++i) packs.push_back(ramp(100 * i));
    for (int lanes = 1; lanes <= pack_width; ++lanes) {
      std::vector<double> out(count * lanes + 1, -1);
      store_lanes(packs.data(), count, out.data(), lanes);
      bool same = out.back() == -1;
      for (int l = 0; l < lanes; ++l)
        for (int i = 0; i < count; ++i) same = same && out[count * l + i] == 100 * i + l;
      CHECK(same);
    }
  }
}
