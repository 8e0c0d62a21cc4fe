// Messages about obstacles: they name the nearest object, and the tightest of all bounds.
#include "framework/stepping/obstacle.hpp"

#include <catch2/catch.hpp>

#include "tests/framework/stepping/hand_made_world.hpp"

using namespace tack;

namespace {

// A filter with a given bound.
class GivenFilter : public StepFilter {
 public:
  explicit GivenFilter(std::optional<Blocker> blocker) : blocker_(std::move(blocker)) {}
  bool attach(const FeasibilityContext& /*context*/) override { return true; }
  double largest_step(const VecX& /*x*/, const VecX& /*p*/, double t_max) override { return blocker_ ? std::min(blocker_->step, t_max) : t_max; }
  std::optional<Blocker> blocker(const VecX& /*x*/, const VecX& /*p*/) override { return blocker_; }

 private:
  std::optional<Blocker> blocker_;
};

std::vector<std::unique_ptr<StepFilter>> filters(std::vector<std::optional<Blocker>> blockers) {
  std::vector<std::unique_ptr<StepFilter>> all;
  for (auto& b : blockers) all.push_back(std::make_unique<GivenFilter>(std::move(b)));
  return all;
}

// Three squares at heights 0, 0.1 and 0.25; the ranges of contact reach to the next one.
SurfaceBuilder shelves() {
  SurfaceBuilder builder;
  for (const double height : {0.0, 0.1, 0.25}) builder.add_rectangle({2, 2}, height > 0.2 ? 2 : height > 0 ? 1 : 0, {0, 0, height}, 1, 1);
  return builder;
}

}  // namespace

TEST_CASE("the tightest bound of all filters is described, for any order of the filters", "[stepping][obstacle]") {
  const HandMadeWorld made(shelves(), 0.2);
  VecX p = VecX::Zero(made.world.rest.size());
  p[4] = -0.5;
  const Blocker loose{{0}, {9, 10, 12}, 0.1, 0.5}, tight{{1, 2}, {9, 10}, 0.003, 0.03};
  for (const auto& order : {std::vector<std::optional<Blocker>>{loose, tight}, {tight, loose}, {std::nullopt, tight}, {tight, std::nullopt}}) {
    const std::string text = describe_blocker(made.world, filters(order), made.world.rest, p);
    CHECK(text == "cut to 0.03 of its length (0.5 m) by edge (1, 2) of 'a' and edge (0, 1) of 'b', 0.003 m apart");
  }
}

TEST_CASE("an element that bounds a step is named alone, and the description of a free step is empty", "[stepping][obstacle]") {
  const HandMadeWorld made(shelves(), 0.2);
  const VecX p = VecX::Ones(made.world.rest.size());
  CHECK(describe_blocker(made.world, filters({Blocker{{9, 10, 11, 12}, {}, 0, 0.25}}), made.world.rest, p) ==
        "cut to 0.25 of its length (1 m) by tet (0, 1, 2, 3) of 'b', which it would crush");
  CHECK(describe_blocker(made.world, filters({std::nullopt}), made.world.rest, p).empty());
  CHECK(describe_blocker(made.world, {}, made.world.rest, p).empty());
}

TEST_CASE("the obstacle of a vertex is the nearest object within range, or the body itself", "[stepping][obstacle]") {
  HandMadeWorld made(shelves(), 0.2);
  ContactSystem& contact = *made.world.contact;
  const VecX& x = made.world.rest;
  contact.begin_step({x, 0, 1});
  contact.move_to(x);
  const auto obstacle = [&](int v) { return describe_obstacle(made.world, x, v, 0.002); };
  CHECK_THAT(obstacle(3), Catch::Contains("'a' into 'b'") && Catch::Contains("vertex 3 of 'a'") && Catch::Contains("0.002 m"));
  CHECK_THAT(obstacle(9), Catch::Contains("'b' into 'a'"));  // 0.1 m away; 'c' is 0.15 m away
  CHECK_THAT(obstacle(20), Catch::Contains("'c' into 'b'"));
}

TEST_CASE("without an object in range, the obstacle is the deformation of the body", "[stepping][obstacle]") {
  CollidingObjects colliding;  // without contact of an object with itself, whose own triangles are always near
  for (int a = 0; a < 3; ++a) colliding.set(a, a, false);
  HandMadeWorld made(shelves(), 0.01, colliding);
  const VecX& x = made.world.rest;
  made.world.contact->begin_step({x, 0, 1});
  made.world.contact->move_to(x);
  const std::string near = describe_obstacle(made.world, x, 3, 0.002);
  CHECK_THAT(near, Catch::Contains("deforms 'a' too far"));
  made.world.contact.reset();
  CHECK(describe_obstacle(made.world, x, 3, 0.002) == near);
}
