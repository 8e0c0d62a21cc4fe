#include "geometry/broad_phase/object_pair_filter.hpp"

#include <catch2/catch.hpp>

using tack::ObjectPairFilter;

TEST_CASE("the object pair filter is symmetric and grows", "[object_pair_filter]") {
  ObjectPairFilter filter;
  REQUIRE(filter.allows(0, 5));
  filter.set(1, 0, false);
  filter.set(7, 3, false);
  REQUIRE_FALSE(filter.allows(0, 1));
  REQUIRE_FALSE(filter.allows(1, 0));
  REQUIRE_FALSE(filter.allows(3, 7));
  REQUIRE(filter.allows(3, 3));
  REQUIRE(filter.allows(100, 1));
  REQUIRE(filter.allows(-1, 1));
  filter.set(0, 1, true);
  REQUIRE(filter.allows(1, 0));
}

TEST_CASE("a filter may exclude whatever it does not list", "[object_pair_filter]") {
  ObjectPairFilter filter(false);
  filter.set(2, 2, true);
  REQUIRE(filter.allows(2, 2));
  REQUIRE_FALSE(filter.allows(1, 2));
  REQUIRE_FALSE(filter.allows(9, 9));
}
