// Order of boxes along a space-filling curve: a permutation in which neighbours are near each other.
#include "geometry/broad_phase/space_order.hpp"

#include <catch2/catch.hpp>
#include <algorithm>
#include <cstdint>
#include <numeric>
#include <random>

using namespace tack;

namespace {

std::vector<Aabb> random_boxes(int n, unsigned seed) {
  std::mt19937 generator(seed);
  std::uniform_real_distribution<double> coordinate(-1, 1), size(0, 0.1);
  std::vector<Aabb> boxes(n);
  for (Aabb& b : boxes) {
    const Vec3 at(coordinate(generator), coordinate(generator), coordinate(generator));
    b.include(at);
    b.include(Vec3(at + Vec3::Constant(size(generator))));
  }
  return boxes;
}

bool is_permutation(std::vector<int> order) {
  std::sort(order.begin(), order.end());
  for (size_t i = 0; i < order.size(); ++i)
    if (order[i] != static_cast<int>(i)) return false;
  return true;
}

double length(const std::vector<Aabb>& boxes, const std::vector<int>& order) {
  double sum = 0;
  for (size_t i = 1; i < order.size(); ++i) sum += ((boxes[order[i]].lo + boxes[order[i]].hi) - (boxes[order[i - 1]].lo + boxes[order[i - 1]].hi)).norm() / 2;
  return sum;
}

}  // namespace

TEST_CASE("the space order is a permutation, of none and of one box too", "[broad_phase]") {
  CHECK(space_order({}).empty());
  for (const int n : {1, 2, 17, 5000}) {
    const std::vector<int> order = space_order(random_boxes(n, 1));
    CHECK(order.size() == static_cast<size_t>(n));
    CHECK(is_permutation(order));
  }
}

TEST_CASE("the eight octants of a cube are visited one after another, the first axis fastest", "[broad_phase]") {
  std::vector<Aabb> boxes(8);
  for (int i = 0; i < 8; ++i) boxes[7 - i].include(Vec3(i & 1, i >> 1 & 1, i >> 2 & 1));
  const std::vector<int> order = space_order(boxes);
  // Each half, and each quarter, is visited as a whole, whatever the order of axes.
  for (const int size : {2, 4})
    for (int first = 0; first < 8; first += size) {
      Aabb block;
      for (int k = first; k < first + size; ++k) block.include(boxes[order[k]]);
      CHECK((block.hi - block.lo).sum() == (size == 2 ? 1 : 2));
    }
}

TEST_CASE("the space order is that of interleaved bits of the centres, by brute force", "[broad_phase]") {
  // Most of them near one point, so that all bits count.
  auto boxes = random_boxes(2000, 6);
  for (Aabb& b : boxes) {
    const Vec3 p = b.lo.array() * b.lo.array().pow(6);
    b = {};
    b.include(p);
  }
  Aabb centres;
  for (const Aabb& b : boxes) centres.include(Vec3((b.lo + b.hi) / 2));
  const double scale = ((1 << 21) - 1) / (centres.hi - centres.lo).maxCoeff();
  std::vector<std::pair<std::uint64_t, int>> keys;
  for (size_t i = 0; i < boxes.size(); ++i) {
    const Vec3 cell = scale * ((boxes[i].lo + boxes[i].hi) / 2 - centres.lo);
    std::uint64_t key = 0;
    for (int bit = 20; bit >= 0; --bit)
      for (int axis = 2; axis >= 0; --axis) key = 2 * key + (static_cast<std::uint64_t>(cell[axis]) >> bit & 1);
    keys.emplace_back(key, static_cast<int>(i));
  }
  std::sort(keys.begin(), keys.end());
  const std::vector<int> order = space_order(boxes);
  for (size_t k = 0; k < order.size(); ++k) CHECK(order[k] == keys[k].second);
}

TEST_CASE("boxes at one position keep their order", "[broad_phase]") {
  const std::vector<Aabb> boxes(20, random_boxes(1, 2)[0]);
  const std::vector<int> order = space_order(boxes);
  CHECK(std::is_sorted(order.begin(), order.end()));
}

TEST_CASE("the path along the space order is many times shorter than in a random order", "[broad_phase]") {
  const auto boxes = random_boxes(4000, 3);
  std::vector<int> given(boxes.size());
  std::iota(given.begin(), given.end(), 0);
  CHECK(length(boxes, space_order(boxes)) < 0.15 * length(boxes, given));
}

TEST_CASE("the space order follows the boxes through renumbering, scaling and translation", "[broad_phase]") {
  const auto boxes = random_boxes(300, 4);
  const std::vector<int> order = space_order(boxes);
  auto reversed = boxes;
  std::reverse(reversed.begin(), reversed.end());
  const std::vector<int> again = space_order(reversed);
  for (size_t k = 0; k < order.size(); ++k) CHECK(again[k] == static_cast<int>(boxes.size()) - 1 - order[k]);
  auto scaled = boxes;
  for (Aabb& b : scaled) b.lo *= 4, b.hi *= 4;  // exact in floating point
  CHECK(space_order(scaled) == order);
}

TEST_CASE("boxes of one rigid group are consecutive, at the position of the first of them", "[broad_phase]") {
  const auto boxes = random_boxes(200, 5);
  std::vector<int> group(boxes.size(), -1);
  for (size_t i = 0; i < group.size(); ++i)
    if (i % 5 == 0) group[i] = static_cast<int>(i / 5 % 3);
  const std::vector<int> order = space_order(boxes, group), alone = space_order(boxes);
  CHECK(is_permutation(order));
  for (int g = 0; g < 3; ++g) {
    std::vector<size_t> at;
    for (size_t k = 0; k < order.size(); ++k)
      if (group[order[k]] == g) at.push_back(k);
    CHECK(at.back() - at.front() + 1 == at.size());
    const auto first = *std::find_if(alone.begin(), alone.end(), [&](int i) { return group[i] == g; });
    CHECK(order[at.front()] == first);
    // As many others come before the group as before its first box.
    const int lowest = static_cast<int>(std::find(group.begin(), group.end(), g) - group.begin());
    const auto others_before = [&](const std::vector<int>& list, auto end) { return std::count_if(list.begin(), end, [&](int i) { return group[i] < 0; }); };
    CHECK(others_before(order, order.begin() + static_cast<std::ptrdiff_t>(at.front())) == others_before(alone, std::find(alone.begin(), alone.end(), lowest)));
  }
  // The others keep their order.
  std::vector<int> others, others_alone;
  std::copy_if(order.begin(), order.end(), std::back_inserter(others), [&](int i) { return group[i] < 0; });
  std::copy_if(alone.begin(), alone.end(), std::back_inserter(others_alone), [&](int i) { return group[i] < 0; });
  CHECK(others == others_alone);
}
