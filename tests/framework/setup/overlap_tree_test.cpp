// Groups of overlapping boxes against those of all pairs.
#include "framework/setup/overlap_tree.hpp"

#include <catch2/catch.hpp>
#include <numeric>
#include <random>

#include "framework/core/disjoint_sets.hpp"

using namespace tack;

namespace {

OverlapTree::Boxes random_boxes(int n, double size, double width) {
  std::mt19937 random(n);
  std::uniform_real_distribution<double> coordinate(0, size);
  OverlapTree::Boxes boxes;
  for (int i = 0; i < n; ++i) {
    const Eigen::Vector3d low(coordinate(random), coordinate(random), coordinate(random));
    boxes.emplace_back(low, (low.array() + width).matrix());
  }
  return boxes;
}

struct Joined {
  std::vector<int> group;
  int calls = 0;
};
Joined joined(const OverlapTree::Boxes& boxes) {
  const int n = static_cast<int>(boxes.size());
  DisjointSets sets(n);
  Joined result;
  std::vector<int> items(n);
  std::iota(items.begin(), items.end(), 0);
  OverlapTree(boxes, items).join_overlapping([&](int i) { return sets.find(i); }, [&](int a, int b) {
    CHECK(boxes[a].intersects(boxes[b]));
    sets.join(a, b);
    ++result.calls;
  });
  for (int i = 0; i < n; ++i) result.group.push_back(sets.find(i));
  return result;
}

}  // namespace

TEST_CASE("overlapping boxes are joined as by all pairs", "[setup]") {
  for (const int n : {0, 1, 2, 5, 40, 300})
    for (const double width : {0.02, 0.1, 0.2, 2.0}) {
      const OverlapTree::Boxes boxes = random_boxes(n, 1, width);
      DisjointSets sets(n);
      for (int a = 0; a < n; ++a)
        for (int b = 0; b < a; ++b)
          if (boxes[a].intersects(boxes[b])) sets.join(a, b);
      const Joined result = joined(boxes);
      for (int i = 0; i < n; ++i) CHECK(result.group[i] == sets.find(i));
    }
}

TEST_CASE("boxes that all overlap are joined by a number of pairs in proportion to theirs", "[setup]") {
  for (const int n : {1000, 10000}) CHECK(joined(random_boxes(n, 1, 2)).calls < 20 * n);
}
