// Axis-aligned boxes, one by one and in packs of eight: union, overlap and area against the
// definitions.
#include "geometry/broad_phase/aabb.hpp"

#include <catch2/catch.hpp>
#include <random>

#include "geometry/broad_phase/box8.hpp"

using namespace tack;

namespace {

class Boxes {
 public:
  explicit Boxes(unsigned seed) : generator_(seed) {}
  double number() { return std::uniform_int_distribution<int>(-4, 4)(generator_); }  // so that boxes often touch
  Vec3 point() { return {number(), number(), number()}; }
  Aabb box() {
    Aabb b;
    b.include(point());
    b.include(point());
    return b;
  }

 private:
  std::mt19937 generator_;
};

bool share_a_point(const Aabb& a, const Aabb& b) {
  for (int i = 0; i < 3; ++i)
    if (std::max(a.lo[i], b.lo[i]) > std::min(a.hi[i], b.hi[i])) return false;
  return true;
}

}  // namespace

TEST_CASE("an empty box contains no point, overlaps nothing and has no area", "[broad_phase]") {
  Boxes random(1);
  const Aabb empty;
  CHECK(empty.half_area() == 0);
  CHECK_FALSE(empty.overlaps(empty));
  for (int i = 0; i < 20; ++i) {
    CHECK_FALSE(empty.contains(random.point()));
    CHECK_FALSE(empty.overlaps(random.box()));
    // It is the neutral element of the union.
    Aabb box = random.box();
    const Aabb before = box;
    box.include(empty);
    CHECK(box.lo == before.lo);
    CHECK(box.hi == before.hi);
  }
}

TEST_CASE("boxes overlap if they share a point, symmetrically, and boxes that touch do", "[broad_phase]") {
  Boxes random(2);
  int touching = 0;
  for (int i = 0; i < 500; ++i) {
    const Aabb a = random.box(), b = random.box();
    CHECK(a.overlaps(b) == share_a_point(a, b));
    CHECK(a.overlaps(b) == b.overlaps(a));
    CHECK(a.overlaps(a));
    touching += a.overlaps(b) && (a.hi.array() == b.lo.array()).any();
  }
  CHECK(touching > 10);
}

TEST_CASE("a union contains both boxes, and is the smallest such box", "[broad_phase]") {
  Boxes random(3);
  for (int i = 0; i < 100; ++i) {
    const Aabb a = random.box(), b = random.box();
    Aabb both = a;
    both.include(b);
    for (const Aabb* box : {&a, &b}) {
      CHECK(both.contains(box->lo));
      CHECK(both.contains(box->hi));
    }
    CHECK(both.lo == Vec3(a.lo.cwiseMin(b.lo)));
    CHECK(both.hi == Vec3(a.hi.cwiseMax(b.hi)));
    CHECK(both.half_area() >= std::max(a.half_area(), b.half_area()));
  }
}

TEST_CASE("an inflated box contains the points within that distance along each axis", "[broad_phase]") {
  Aabb box;
  box.include(Vec3(0, 0, 0));
  box.include(Vec3(1, 2, 3));
  CHECK(box.half_area() == 2 + 6 + 3);
  box.inflate(0.5);
  CHECK(box.half_area() == 2 * 3 + 3 * 4 + 4 * 2);
  CHECK(box.contains({-0.5, 2.5, 3.5}));
  CHECK_FALSE(box.contains({-0.51, 0, 0}));
}

TEST_CASE("eight boxes overlap one as each of them does, and empty lanes overlap nothing", "[broad_phase]") {
  Boxes random(4);
  for (int trial = 0; trial < 200; ++trial) {
    std::array<Aabb, Box8::width> boxes;  // some stay empty
    Box8 pack;
    for (int i = 0; i < Box8::width; ++i) {
      if (trial % (i + 2) != 0) boxes[i] = random.box();
      pack.set(i, boxes[i]);
    }
    const Aabb query = random.box();
    const unsigned mask = pack.overlap_mask(query);
    for (int i = 0; i < Box8::width; ++i) {
      CHECK((mask >> i & 1) == boxes[i].overlaps(query));
      CHECK(pack.get(i).lo == boxes[i].lo);
      CHECK(pack.get(i).hi == boxes[i].hi);
    }
    CHECK(mask >> Box8::width == 0);
    CHECK(pack.overlap_mask(Aabb()) == 0);
  }
}
