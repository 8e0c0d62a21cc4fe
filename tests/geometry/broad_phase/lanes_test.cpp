#include "geometry/broad_phase/lanes.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>
#include <vector>

using namespace tack::detail;

TEST_CASE("lanes are compared and packed", "[lanes]") {
  const int ids[8] = {5, -1, 9, 3, 12, 7, 0, 6};
  REQUIRE(lanes_above(ids, 6) == 0b00110100u);
  for (unsigned mask = 0; mask < 256; ++mask) {
    int packed[8];
    std::vector<int> expected;
    for (int i = 0; i < 8; ++i)
      if (mask >> i & 1u) expected.push_back(ids[i]);
    const int* end = append_lanes(ids, mask, packed);
    REQUIRE(std::vector<int>(packed, static_cast<int*>(packed) + (end - packed)) == expected);
  }
}

TEST_CASE("distinct ids are sorted at every length", "[lanes]") {
  std::mt19937 random(1);
  for (int count = 0; count < 80; ++count) {
    std::vector<int> sorted(count), ids;
    std::iota(sorted.begin(), sorted.end(), -3);
    ids = sorted;
    std::shuffle(ids.begin(), ids.end(), random);
    sort_distinct(ids.data(), count);
    REQUIRE(ids == sorted);
  }
}
