#include "geometry/broad_phase/object_classes.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "geometry/broad_phase/colliding_objects.hpp"

using tack::CollidingObjects;
using tack::ObjectClasses;

TEST_CASE("pairs of objects share an entry if their classes agree and none is an object with itself", "[broad_phase]") {
  const ObjectClasses classes({0, 1, 0, 1, 2});
  CHECK(classes.index(0, 1) == classes.index(2, 3));
  CHECK(classes.index(0, 1) != classes.index(1, 0));
  CHECK(classes.index(0, 2) == classes.index(2, 0));
  CHECK(classes.index(0, 0) == classes.index(2, 2));
  CHECK(classes.index(0, 0) != classes.index(0, 2));
  std::set<std::size_t> places;
  for (int a = 0; a < 5; ++a)
    for (int b = 0; b < 5; ++b) places.insert(classes.index(a, b));
  CHECK(places.size() == 9 + 3 - 1);  // class 2 has one object, and no pair of two
  CHECK(*places.rbegin() < classes.entries());
}

TEST_CASE("examples represent all pairs of objects, in the order of their first occurrence", "[broad_phase]") {
  const std::vector<int> of = {0, 1, 0, 2, 1, 1, 3};
  const ObjectClasses classes(of);
  std::vector<std::pair<int, int>> first;
  std::set<std::set<std::size_t>> known;
  double pairs = 0;
  for (int a = 0; a < 7; ++a)
    for (int b = a; b < 7; ++b)
      if (known.insert({classes.index(a, b), classes.index(b, a)}).second) first.emplace_back(a, b);
  CHECK(classes.examples() == first);
  for (const auto& [a, b] : first) pairs += classes.pairs_like(a, b);
  CHECK(pairs == 7 * 8 / 2);
}

TEST_CASE("an entry of two objects holds for all objects of their classes", "[broad_phase]") {
  CollidingObjects colliding(ObjectClasses({0, 1, 0, 1}));
  colliding.set(0, 1, false);
  colliding.set(1, 1, false);
  CHECK_FALSE(colliding.allows(3, 2));
  CHECK_FALSE(colliding.allows(3, 3));
  CHECK(colliding.allows(1, 3));
  CHECK(colliding.allows(0, 2));
}
