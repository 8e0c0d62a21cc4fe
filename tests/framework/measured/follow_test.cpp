#include "framework/measured/follow.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cmath>

using namespace tack;

namespace {

using List = std::vector<double>;

}  // namespace

TEST_CASE("a run with monotonic abscissa is a function of it, for any order of the data", "[measured]") {
  const List x = {0, 1, 2, 4}, y = {0, 10, 20, 0};
  CHECK(follow(List{0.5, 3, 0, 4}, x, y) == List{5, 10, 0, 0});
  CHECK(follow(List{3, 0.5}, x, y) == List{10, 5});
  // Also for a decreasing abscissa.
  CHECK(follow(List{0.5, 3}, List{4, 2, 1, 0}, List{0, 20, 10, 0}) == List{5, 10});
  // At a constant abscissa the first sample counts.
  CHECK(follow(List{1}, List{0, 1, 1, 2}, List{0, 10, 7, 8}) == List{10});
}

TEST_CASE("points that a run never passes have no value", "[measured]") {
  const List found = follow(List{-0.1, 0, 2, 2.1}, List{0, 2}, List{1, 3});
  CHECK(std::isnan(found[0]));
  CHECK(found[1] == 1);
  CHECK(found[2] == 3);
  CHECK(std::isnan(found[3]));
  CHECK(std::isnan(follow(List{1}, List{}, List{})[0]));
  CHECK(follow(List{1}, List{1}, List{5}) == List{5});
}

TEST_CASE("a run whose sum of steps is slightly short reaches the last point", "[measured]") {
  List x = {0}, y = {0};
  for (int i = 0; i < 1000; ++i) x.push_back(x.back() + 0.1), y.push_back(2 * x.back());
  REQUIRE(x.back() != 100);
  CHECK(follow(List{100}, x, y)[0] == Approx(200));
}

TEST_CASE("loading and unloading are followed in time", "[measured]") {
  // Up to 4 along y = x, down along y = x / 2 - 1, and up again along y = 10 x.
  const List x = {0, 4, 2, 5}, y = {0, 4, 0, 50};
  const List found = follow(List{1, 3, 3.5, 3, 2.5, 3, 4.5}, x, y), exact = {1, 3, 3.5, 2, 1, 50.0 / 3, 125.0 / 3};
  for (size_t i = 0; i < exact.size(); ++i) CHECK(found[i] == Approx(exact[i]));
  // Data of the unloading alone take the passages of the unloading.
  CHECK(follow(List{3.5, 2.5}, x, y) == List{3, 1});
  // Data that reverse beyond the reversal of the run: the point there is missed, the unloading is not.
  const List beyond = follow(List{3, 5.5, 3}, List{0, 4, 0}, List{0, 4, 40});
  CHECK(beyond[0] == 3);
  CHECK(std::isnan(beyond[1]));
  CHECK(beyond[2] == 13);
}

TEST_CASE("nothing is passed between the parts of a run", "[measured]") {
  const List x = {0, 2, 6, 8}, y = {0, 2, 60, 80};
  const std::vector<size_t> starts = {0, 2};
  const List found = follow(List{1, 4, 7}, x, y, starts);
  CHECK(found[0] == 1);
  CHECK(std::isnan(found[1]));
  CHECK(found[2] == 70);
  CHECK(follow(List{4}, x, y)[0] == 31);
  // Each part is monotonic: data may be in any order, and a part may have a single sample.
  const std::vector<size_t> twice = {0, 2, 4};
  const List pressed = {3, 1, 3, 1, 7}, force = {30, 10, 31, 11, 70};
  for (const List& points : {List{1, 2, 3, 7}, List{7, 3, 2, 1}})
    for (const double p : points) CHECK(follow(points, pressed, force, twice)[static_cast<size_t>(std::find(points.begin(), points.end(), p) - points.begin())] == 10 * p);
}

TEST_CASE("small oscillations of the abscissa do not change the result", "[measured]") {
  List x, y;
  for (int i = 0; i <= 100; ++i) x.push_back(i + (i % 2 ? 0.8 : 0)), y.push_back(i);
  for (const double found : follow(List{10, 20.5, 50, 90}, x, y)) CHECK(std::isfinite(found));
  CHECK(follow(List{10, 20.5, 50, 90}, x, y)[3] == Approx(90).margin(1));
}
