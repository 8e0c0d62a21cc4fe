// The parallel sort agrees with std::sort.
#include <catch2/catch.hpp>

#include <random>
#include <utility>
#include <vector>

#include "geometry/parallel_sort.hpp"

using namespace tack;

TEST_CASE("parallel_sort sorts any number of items, also with many equal ones") {
  std::mt19937 random(7);
  for (const int n : {0, 1, 2, 4095, 4096, 4097, 8192, 12289, 50000}) {
    for (const int distinct : {1, 10, 1000000}) {
      CAPTURE(n, distinct);
      std::vector<std::pair<int, int>> items(n);
      for (int i = 0; i < n; ++i) items[i] = {static_cast<int>(random() % distinct), i};
      auto expected = items;
      std::sort(expected.begin(), expected.end());
      parallel_sort(items);
      CHECK(items == expected);
    }
  }
}

TEST_CASE("the split of a merge takes as many of the first range as the merged order has") {
  const std::vector<int> a = {1, 3, 3, 5}, b = {2, 3, 4};
  std::vector<int> merged(7);
  std::merge(a.begin(), a.end(), b.begin(), b.end(), merged.begin());
  for (int taken = 0; taken <= 7; ++taken) {
    const int from_a = detail::merge_split(a.data(), 4, b.data(), 3, taken);
    std::vector<int> head(taken);
    std::merge(a.begin(), a.begin() + from_a, b.begin(), b.begin() + (taken - from_a), head.begin());
    CHECK(head == std::vector<int>(merged.begin(), merged.begin() + taken));
  }
}
