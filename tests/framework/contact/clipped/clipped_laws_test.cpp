// Tables of the laws of clipped adhesion.
#include "framework/contact/clipped/clipped_laws.hpp"

#include <catch2/catch.hpp>

#include "tests/framework/contact/clipped/clipped_plates.hpp"

using namespace tack;

TEST_CASE("clipped laws: those of two objects are the same where they are alone", "[clipped]") {
  ClippedLaws laws(ObjectClasses::single(3));
  const int of_objects = laws.add(tent_law(), 4), of_regions = laws.add(steep_law(), 5), within = laws.half_of(of_objects);
  laws.set(0, 2, of_objects, -1, -1);
  laws.set(0, 2, of_regions, 1, 0);
  laws.set_planes(0, 2, ClippedPlanes::of_first);
  laws.set(2, 2, within, -1, -1);

  const ClippedLaws pair = laws.of_objects(0, 2);
  CHECK(pair.between(0, 1, -1) == of_objects);
  CHECK(pair.between(0, 1, 1) == of_regions);
  CHECK(pair.between(1, 0, 0) == of_regions);
  CHECK(pair.planes(0, 1) == ClippedPlanes::of_first);
  CHECK(pair.planes(1, 0) == ClippedPlanes::of_second);
  CHECK(!pair.any(1, 1));  // an object with itself is another pair
  CHECK(pair.laws()[of_regions].of_table == 5);

  const ClippedLaws self = laws.of_objects(2, 2);
  CHECK(self.between(0, 0, -1) == within);
  CHECK(self.laws()[within].share == 0.5);
}
