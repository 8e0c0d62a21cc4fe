#include "framework/measured/follow.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tack;

namespace {

using List = std::vector<double>;

}  // namespace

TEST_CASE("a run whose abscissa only grows is a function of it, whatever the order of the data", "[measured]") {
  const List x = {0, 1, 2, 4}, y = {0, 10, 20, 0};
  CHECK(follow(List{0.5, 3, 0, 4}, x, y) == List{5, 10, 0, 0});
  CHECK(follow(List{3, 0.5}, x, y) == List{10, 5});
  // Downwards as well.
  CHECK(follow(List{0.5, 3}, List{4, 2, 1, 0}, List{0, 20, 10, 0}) == List{5, 10});
  // Where it stands still, the first number counts.
  CHECK(follow(List{1}, List{0, 1, 1, 2}, List{0, 10, 7, 8}) == List{10});
}

TEST_CASE("what a run never passes has no number", "[measured]") {
  const List found = follow(List{-0.1, 0, 2, 2.1}, List{0, 2}, List{1, 3});
  CHECK(std::isnan(found[0]));
  CHECK(found[1] == 1);
  CHECK(found[2] == 3);
  CHECK(std::isnan(found[3]));
  CHECK(std::isnan(follow(List{1}, List{}, List{})[0]));
  CHECK(follow(List{1}, List{1}, List{5}) == List{5});
}

TEST_CASE("a sum of steps that ends a little short reaches the last point", "[measured]") {
  List x = {0}, y = {0};
  for (int i = 0; i < 1000; ++i) x.push_back(x.back() + 0.1), y.push_back(2 * x.back());
  REQUIRE(x.back() != 100);
  CHECK(follow(List{100}, x, y)[0] == Approx(200));
}

TEST_CASE("loading and unloading are followed by time", "[measured]") {
  // Up to 4 along y = x, down along y = x / 2 - 1, and up again along y = 10 x.
  const List x = {0, 4, 2, 5}, y = {0, 4, 0, 50};
  const List found = follow(List{1, 3, 3.5, 3, 2.5, 3, 4.5}, x, y), exact = {1, 3, 3.5, 2, 1, 50.0 / 3, 125.0 / 3};
  for (size_t i = 0; i < exact.size(); ++i) CHECK(found[i] == Approx(exact[i]));
  // Data on the way down alone take the passages of the way down.
  CHECK(follow(List{3.5, 2.5}, x, y) == List{3, 1});
  // Data that turn beyond the run's own turn: the point there is missed, the way back is not.
  const List beyond = follow(List{3, 5.5, 3}, List{0, 4, 0}, List{0, 4, 40});
  CHECK(beyond[0] == 3);
  CHECK(std::isnan(beyond[1]));
  CHECK(beyond[2] == 13);
}

TEST_CASE("an abscissa that trembles does not lead astray", "[measured]") {
  List x, y;
  for (int i = 0; i <= 100; ++i) x.push_back(i + (i % 2 ? 0.8 : 0)), y.push_back(i);
  for (const double found : follow(List{10, 20.5, 50, 90}, x, y)) CHECK(std::isfinite(found));
  CHECK(follow(List{10, 20.5, 50, 90}, x, y)[3] == Approx(90).margin(1));
}
