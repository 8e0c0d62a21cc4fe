#include "geometry/broad_phase/colliding_objects.hpp"

#include <catch2/catch.hpp>

using tack::CollidingObjects;

TEST_CASE("the table of colliding objects is symmetric and grows", "[colliding_objects]") {
  CollidingObjects colliding;
  REQUIRE(colliding.allows(0, 5));
  colliding.set(1, 0, false);
  colliding.set(7, 3, false);
  REQUIRE_FALSE(colliding.allows(0, 1));
  REQUIRE_FALSE(colliding.allows(1, 0));
  REQUIRE_FALSE(colliding.allows(3, 7));
  REQUIRE(colliding.allows(3, 3));
  REQUIRE(colliding.allows(100, 1));
  REQUIRE(colliding.allows(-1, 1));
  colliding.set(0, 1, true);
  REQUIRE(colliding.allows(1, 0));
}

TEST_CASE("a table may exclude all pairs that it does not list", "[colliding_objects]") {
  CollidingObjects colliding(false);
  colliding.set(2, 2, true);
  REQUIRE(colliding.allows(2, 2));
  REQUIRE_FALSE(colliding.allows(1, 2));
  REQUIRE_FALSE(colliding.allows(9, 9));
}
