#include "geometry/broad_phase/bvh.hpp"

#include <tbb/global_control.h>

#include <catch2/catch.hpp>

#include "geometry/broad_phase/overlap_pairs.hpp"
#include "geometry/errors.hpp"
#include "tests/geometry/broad_phase/scenes.hpp"

using namespace tack;

namespace {

using Pairs = std::vector<std::array<int, 2>>;

struct Everything {
  bool accept(int, int) const { return true; }
  std::array<int, 2> pair(int q, int t) const { return {q, t}; }
};

std::vector<Aabb> random_boxes(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<Aabb> boxes(count);
  for (Aabb& box : boxes) {
    const Vec3 centre = scenes::random_point(random, 1.0);
    for (int k = 0; k < 2; ++k) box.include(Vec3(centre + scenes::random_point(random, 0.1)));
  }
  return boxes;
}

Pairs pairs_of(const Bvh& queries, const Bvh& tree) {
  Pairs pairs;
  overlap_pairs(queries, tree, Everything{}, pairs);
  return pairs;
}

Pairs all_pairs(const std::vector<Aabb>& a, const std::vector<Aabb>& b) {
  Pairs pairs;
  for (int i = 0; i < static_cast<int>(a.size()); ++i)
    for (int j = 0; j < static_cast<int>(b.size()); ++j)
      if (a[i].overlaps(b[j])) pairs.push_back({i, j});
  return pairs;
}

}  // namespace

TEST_CASE("a tree of any size finds all overlapping boxes", "[bvh]") {
  const auto queries = random_boxes(200, 1);
  for (const int count : {0, 1, 7, 8, 9, 63, 64, 65, 513, 1500}) {
    const auto boxes = random_boxes(count, 2);
    REQUIRE(pairs_of(Bvh(queries), Bvh(boxes)) == all_pairs(queries, boxes));
    REQUIRE(pairs_of(Bvh(boxes), Bvh(queries)) == all_pairs(boxes, queries));
  }
}

TEST_CASE("pairs within one tree are found once", "[bvh]") {
  const auto boxes = random_boxes(700, 3);
  Pairs expected, found;
  for (const auto& pair : all_pairs(boxes, boxes))
    if (pair[0] < pair[1]) expected.push_back(pair);
  overlap_pairs(Bvh(boxes), Everything{}, found);
  REQUIRE(found == expected);
}

TEST_CASE("boxes that coincide, touch or have no size are found", "[bvh]") {
  std::vector<Aabb> boxes(50);
  for (Aabb& box : boxes) box.include(Vec3(1.0, 2.0, 3.0));
  REQUIRE(pairs_of(Bvh(boxes), Bvh(boxes)).size() == 2500);
  Aabb left, right;
  left.include(Vec3(0, 0, 0));
  left.include(Vec3(1, 1, 1));
  right.include(Vec3(1, 1, 1));
  right.include(Vec3(2, 2, 2));
  REQUIRE(pairs_of(Bvh({left}), Bvh({right})).size() == 1);
  right.lo[1] = std::nextafter(1.0, 2.0);
  REQUIRE(pairs_of(Bvh({left}), Bvh({right})).empty());
}

TEST_CASE("two inactive boxes are never a pair", "[bvh]") {
  const auto boxes = random_boxes(600, 4);
  std::vector<char> active(600, 0);
  for (int i = 0; i < 600; i += 5) active[i] = 1;
  Pairs expected;
  for (const auto& pair : all_pairs(boxes, boxes))
    if (active[pair[0]] || active[pair[1]]) expected.push_back(pair);
  const Bvh tree(boxes, active);
  REQUIRE(pairs_of(tree, tree) == expected);
}

TEST_CASE("a refit keeps the order until the nodes have grown", "[bvh]") {
  auto boxes = random_boxes(900, 5);
  Bvh tree(boxes);
  for (Aabb& box : boxes) box.inflate(1e-3);
  REQUIRE_FALSE(tree.update(boxes));
  REQUIRE(pairs_of(tree, tree) == all_pairs(boxes, boxes));
  boxes = random_boxes(900, 6);  // elsewhere altogether
  REQUIRE(tree.update(boxes));
  REQUIRE(pairs_of(tree, tree) == all_pairs(boxes, boxes));
  boxes = random_boxes(900, 7);
  REQUIRE_FALSE(tree.update(boxes, 1e9));  // a bad order is slow, not wrong
  REQUIRE(pairs_of(tree, tree) == all_pairs(boxes, boxes));
}

TEST_CASE("the tree is the same for one and two threads", "[bvh]") {
  const auto boxes = random_boxes(30000, 8);
  std::vector<std::vector<int>> orders;
  for (const std::size_t threads : {1, 2}) {
    tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    const Bvh tree(boxes);
    orders.emplace_back(tree.primitives(0), tree.primitives(0) + tree.size());
  }
  REQUIRE(orders[0] == orders[1]);
}

TEST_CASE("wrong numbers of boxes are refused", "[bvh]") {
  REQUIRE_THROWS_AS(Bvh(random_boxes(3, 1), {1, 1}), InputError);
  Bvh tree(random_boxes(3, 1));
  REQUIRE_THROWS_AS(tree.update(random_boxes(4, 1)), InputError);
}
