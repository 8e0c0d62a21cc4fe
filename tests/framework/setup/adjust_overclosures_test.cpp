// Initial overclosures: objects are moved as little as possible, or the message names the blocking
// object.
#include "framework/setup/adjust_overclosures.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <random>

#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string box(const std::string& name, const Vec3& at, const std::string& more, const Vec3& size = Vec3::Constant(0.1), double angle = 0) {
  return fmt::format("  - {{name: {}, shape: {{type: box, size: [{}, {}, {}]}}, place: {{translate: [{:.17g}, {:.17g}, {:.17g}], angle: {}}}, {}}}\n",
                     name, size.x(), size.y(), size.z(), at.x(), at.y(), at.z(), angle, more);
}

const std::string fixed = "motion: [fixed]", loose = "body: affine";

std::string scene_of(const std::string& objects, const std::string& contact = "overclosure_adjustment: 5 mm") {
  return "objects:\n" + objects + "contact: {distance: 1 mm, " + contact + "}\n";
}

// Returns the displacement of the first vertex of an object, compared with a scene without contact.
Vec3 moved(const TestScene& scene, const std::string& objects, const std::string& name) {
  TestScene plain("objects:\n" + objects);
  const World& world = *scene.world;
  const int v = world.bodies[world.body_index(name)].first_vertex;
  return vertex(world.rest, v) - vertex(plain.world->rest, v);
}

}  // namespace

TEST_CASE("blocks that overlap by 1 mm come apart by that and half the contact distance", "[push_out]") {
  const double angle = GENERATE(0.0, 0.6);
  const double far = GENERATE(0.0, 1e3);
  const Vec3 at(far, -far, far / 3);
  CAPTURE(angle, far);
  const std::string objects = box("floor", at, fixed) + box("block", at + Vec3(0, 0.099, 0), loose, Vec3::Constant(0.1), angle);
  CHECK_THROWS_WITH(TestScene(scene_of(objects, "safety_barrier: 0.5")), Contains("the start intersects"));
  const TestScene scene(scene_of(objects));
  CHECK((moved(scene, objects, "block") - Vec3(0, 1.5e-3, 0)).norm() < 1e-9);
  CHECK(moved(scene, objects, "floor").norm() == 0);
  REQUIRE(scene.world->start_notes.size() == 1);
  CHECK_THAT(scene.world->start_notes[0], Contains("'block' is pushed by 0.0015 m") && Contains("away from 'floor'"));
  CHECK(scene.world->contact->smallest_gaps(scene.world->rest).of_all > 0);
}

TEST_CASE("of two free objects, the smaller one moves farther; offsets are kept", "[push_out]") {
  const std::string objects = box("large", Vec3::Zero(), loose, Vec3(0.2, 0.1, 0.1)) + box("small", Vec3(0, 0.1005, 0), loose + ", contact_offset: 2 mm");
  const TestScene scene(scene_of(objects));
  const double large = moved(scene, objects, "large").y(), small = moved(scene, objects, "small").y();
  CHECK(small - large == Approx(2e-3));
  CHECK(small == Approx(-2 * large));
}

TEST_CASE("objects without overlap, and pairs without contact, stay", "[push_out]") {
  const std::string near = box("floor", Vec3::Zero(), fixed) + box("block", Vec3(0, 0.1001, 0), loose);
  CHECK(TestScene(scene_of(near)).world->start_notes.empty());
  const std::string through = box("floor", Vec3::Zero(), fixed) + box("block", Vec3(0, 0.05, 0), loose);
  CHECK(TestScene(scene_of(through, "overclosure_adjustment: 5 mm, pairs: [{between: [block, floor], contact: false}]")).world->start_notes.empty());
}

TEST_CASE("a heap of overlapping balls is separated, with the same result twice", "[push_out]") {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> at(-0.1, 0.1);
  std::string balls;
  for (int i = 0; i < 60; ++i)
    balls += fmt::format("  - {{name: ball_{}, shape: {{type: sphere, radius: 0.02, cells: 4, surface: true}}, place: {{translate: [{}, {}, {}]}}, {}}}\n", i,
                         at(random), at(random), at(random), loose);
  balls += box("wall", Vec3(0.13, 0, 0), fixed, Vec3(0.08, 0.4, 0.4));
  CHECK_THROWS_WITH(TestScene(scene_of(balls, "safety_barrier: 0.5")), Contains("the start intersects"));
  const TestScene scene(scene_of(balls, "overclosure_adjustment: 40 mm")), again(scene_of(balls, "overclosure_adjustment: 40 mm"));
  CHECK(scene.world->start_notes.size() == 11);
  CHECK_THAT(scene.world->start_notes.back(), Contains("more objects"));
  CHECK(scene.world->rest == again.world->rest);
}

TEST_CASE("a sheet in a box leaves it through the nearest face", "[push_out]") {
  const std::string objects = box("box", Vec3::Zero(), fixed) +
                              "  - {name: sheet, shape: {type: grid, size: [0.06, 0.06], cells: [4, 4]}, "
                              "place: {translate: [0, 0.048, 0]}, shell: {thickness: 1 mm}, energies: [{type: stvk_membrane, young: 1 MPa, poisson: 0.3, density: 1000}]}\n";
  const TestScene scene(scene_of(objects));
  CHECK((moved(scene, objects, "sheet") - Vec3(0, 2.5e-3, 0)).norm() < 1e-9);
}

TEST_CASE("objects that cannot be separated are refused by name", "[push_out]") {
  const auto walls = [](double apart) { return box("left", Vec3(-apart, 0, 0), fixed) + box("right", Vec3(apart, 0, 0), fixed); };
  CHECK_THROWS_WITH(TestScene(scene_of(walls(0.099) + box("wedge", Vec3::Zero(), loose))),
                    Contains("'wedge' overlap at") && Contains("m deep") && Contains("place.translate"));
  CHECK_THROWS_WITH(TestScene(scene_of(box("floor", Vec3::Zero(), fixed) + box("block", Vec3(0, 0.092, 0), loose))),
                    Contains("'floor' and 'block' overlap") && Contains("'block' would have to go farther than contact.overclosure_adjustment (0.005 m)"));
}

TEST_CASE("objects with prescribed motions or springs stay", "[push_out]") {
  const std::string held = box("floor", Vec3::Zero(), fixed) + box("shelf", Vec3(0, 0.099, 0), fixed) + box("block", Vec3(1, 0, 0), loose);
  CHECK(TestScene(scene_of(held)).world->start_notes.empty());
  const std::string block = box("floor", Vec3::Zero(), fixed) + box("block", Vec3(0, 0.099, 0), loose);
  CHECK_THROWS_WITH(TestScene(scene_of(block) + "interactions: [{type: spring, name: cord, stiffness: 10 N/m, from: {object: block}, to: {object: floor}}]\n"), Contains("the start intersects"));
}
