#include "framework/scene/pair_configs.hpp"

#include <catch2/catch.hpp>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

std::string boxes(const std::string& contact) {
  const auto box = [](const std::string& name, const std::string& groups, double at, const std::string& more) {
    return "  - {name: " + name + ", groups: [" + groups + "], shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [" +
           std::to_string(at) + ", 0, 0]}, " + more + "}\n";
  };
  return "objects:\n" + box("a", "red", 0, "body: affine") + box("b", "red, small", 1, "body: affine") +
         box("c", "small", 2, "body: affine") + box("wall", "", 3, "motion: [{type: translate, velocity: [0, 0.1, 0]}]") + box("floor", "", 3.05, "motion: [fixed]") +
         "contact: {distance: 1e-3, " + contact + "}\n";
}

// mu of the pair's friction; -1: no contact.
double friction(const TestScene& scene, const char* a, const char* b) {
  const World& world = *scene.world;
  const int i = world.body_index(a), j = world.body_index(b);
  if (!world.contact->colliding().allows(i, j)) return -1;
  return world.contact->pairs().tangential(world.contact->pairs().point(i, j).law).mu;
}

constexpr const char* apart = "between_prescribed: false, ";

}  // namespace

TEST_CASE("the most specific entry applies", "[scene]") {
  TestScene scene(boxes(std::string(apart) + "pairs: ["
                        "{between: [\"*\", \"*\"], friction: {mu: 0.1}}, {between: [red, \"*\"], friction: {mu: 0.2}}, "
                        "{between: [red, red], friction: {mu: 0.3}}, {between: [wall, \"*\"], friction: {mu: 0.4}}, "
                        "{between: [wall, red], friction: {mu: 0.5}}, {between: [wall, b], friction: {mu: 0.6}}, "
                        "{between: [c, c], contact: false}]"));
  CHECK(friction(scene, "c", "floor") == 0.1);
  CHECK(friction(scene, "a", "floor") == 0.2);
  CHECK(friction(scene, "c", "b") == 0.2);
  CHECK(friction(scene, "a", "b") == 0.3);
  CHECK(friction(scene, "a", "a") == 0.3);
  CHECK(friction(scene, "c", "wall") == 0.4);
  CHECK(friction(scene, "a", "wall") == 0.5);
  CHECK(friction(scene, "wall", "b") == 0.6);
  CHECK(friction(scene, "c", "c") == -1);
}

TEST_CASE("fixed objects may overlap if the scene allows it", "[scene]") {
  CHECK_THROWS_WITH(TestScene(boxes("safety_barrier: 0.5")), Contains("the start intersects"));
  CHECK_NOTHROW(TestScene(boxes("between_prescribed: false")));
}

TEST_CASE("a named group is the integration side, with all of its objects", "[scene]") {
  TestScene scene(boxes(std::string(apart) + "pairs: [{between: [red, \"*\"], integrate: red}]"));
  const PairTable& pairs = scene.world->contact->pairs();
  const auto id = [&](const char* name) { return scene.world->body_index(name); };
  CHECK(pairs.point(id("a"), id("c")).counts_area);
  CHECK_FALSE(pairs.point(id("c"), id("a")).counts_area);
  CHECK(pairs.point(id("a"), id("b")).area_factor == 0.5);
  CHECK(pairs.point(id("b"), id("a")).area_factor == 0.5);
}

TEST_CASE("invalid pairs are refused", "[scene]") {
  const auto with = [](const std::string& pairs) { return boxes(std::string(apart) + "pairs: [" + pairs + "]"); };
  CHECK_THROWS_WITH(TestScene(with("{between: [rde, a]}")), Contains("no object and no group is named 'rde'") && Contains("red"));
  CHECK_THROWS_WITH(TestScene(with("{between: [a, b]}, {between: [b, a]}")), Contains("given twice"));
  CHECK_THROWS_WITH(TestScene(with("{between: [red, wall], friction: {mu: 0.1}}, {between: [small, wall]}")),
                    Contains("are also a pair of 'red' and 'wall'") && Contains("names the two objects"));
  CHECK_THROWS_WITH(TestScene(with("{between: [red, wall], integrate: small}")), Contains("integrate: 'small'"));
  std::string named = boxes(apart + std::string("safety_barrier: 0.5"));
  named.replace(named.find("groups: [small]"), 15, "groups: [wall]");
  CHECK_THROWS_WITH(TestScene(named), Contains("a group 'wall', which is the name of an object"));
}

TEST_CASE("regions: the applicable entry is reported, and invalid entries are refused with source location", "[scene][parts]") {
  const auto with = [](const std::string& pairs) { return boxes(std::string(apart) + "pairs: [" + pairs + "]"); };
  const std::string top = "{object: a, select: {type: face, direction: [0, 1, 0]}}", left = "{object: a, select: {type: face, direction: [-1, 0, 0]}}";
  TestScene scene(with("{between: [" + top + ", red], friction: {mu: 0.1}}, {between: [" + top + ", b], friction: {mu: 0.2}}, {between: [a, b], friction: {mu: 0.3}}, "
                       "{between: [" + top + ", {object: b, select: all}], friction: {mu: 0.4}}, {between: [" + left + ", b], friction: {mu: 0.5}}"));
  const World& world = *scene.world;
  const PairTable& pairs = world.contact->pairs();
  const int a = world.body_index("a"), b = world.body_index("b"), c = world.body_index("c");
  // Two regions, then single regions in file order; the region of a group is less specific than the entry of the objects.
  REQUIRE(pairs.region_pair_count(a, b) == 3);
  const auto mu = [&](int i, int j, int part) { return pairs.tangential(pairs.point(i, j, part).law).mu; };
  for (const auto& [i, j] : {std::pair(a, b), std::pair(b, a)}) {
    CHECK(mu(i, j, 0) == 0.4);
    CHECK(mu(i, j, 1) == 0.2);
    CHECK(mu(i, j, 2) == 0.5);
    CHECK(mu(i, j, -1) == 0.3);
  }
  CHECK_FALSE(pairs.has_regions(a, c));
  CHECK(pairs.region_pair_count(a, a) == 2);
  CHECK_THROWS_WITH(TestScene(with("{between: [{object: red, select: all}, b]}")), Contains(":") && Contains("a region belongs to a single object, and 'red' is a group"));
  CHECK_THROWS_WITH(TestScene(with("{between: [{object: \"*\", select: all}, b]}")), Contains("all of them"));
  CHECK_THROWS_WITH(TestScene(with("{between: [{object: a, select: {type: tag, name: rim}}, b]}")), Contains("has no group 'rim'"));
  CHECK_THROWS_WITH(TestScene(with("{between: [{object: a, select: {type: indices, vertices: [0]}}, b]}")), Contains("contains no complete triangle"));
  CHECK_THROWS_WITH(TestScene(with("{between: [{object: a, select: all}, b]}, {between: [" + top + ", b]}")), Contains("are also named by an equally specific entry"));
  CHECK_THROWS_WITH(TestScene(with("{between: [" + top + ", b], contact: false}")), Contains("have none in any region"));
  CHECK_THROWS_WITH(TestScene(with("{between: [" + top + ", b]}, {between: [a, b], contact: false}")), Contains("have no contact"));
  CHECK_THROWS_WITH(TestScene(with("{between: [" + top + ", b], integrate: a}, {between: [" + left + ", b], integrate: b}")), Contains("one integration side"));
  CHECK_THROWS_WITH(TestScene(boxes(std::string(apart) + "weights: pair, pairs: [{between: [" + top + ", b]}]")), Contains("contact.model: ipc has no regions of objects"));
}

TEST_CASE("copies share a class; named, thicker or attached objects have their own", "[scene]") {
  TestScene scene("objects:\n"
                  "  - {name: grain, shape: {type: box, size: [0.1, 0.1, 0.1]}, body: affine, fill: {region: {type: sphere, radius: 1}, count: 30, clearance: 0.01}}\n"
                  "  - {name: thick, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [5, 0, 0]}, body: affine, contact_offset: 1e-3}\n"
                  "  - {name: floor, shape: {type: box, size: [9, 0.1, 9]}, place: {translate: [0, -2, 0]}, motion: [fixed]}\n"
                  "contact: {distance: 1e-3, pairs: [{between: [grain, floor], friction: {mu: 0.3}}, {between: [grain, grain], friction: {mu: 0.2}}, "
                  "{between: [grain_7, floor], friction: {mu: 0.4}}, {between: [floor, floor], contact: false}]}\n");
  CHECK(scene.world->contact->pairs().classes().count() == 4);
  CHECK(friction(scene, "grain_3", "floor") == 0.3);
  CHECK(friction(scene, "floor", "grain_7") == 0.4);
  CHECK(friction(scene, "grain_3", "grain_30") == 0.2);
  CHECK(friction(scene, "grain_3", "grain_7") == 0.2);
  CHECK(friction(scene, "grain_3", "thick") == 0);
  CHECK(friction(scene, "floor", "floor") == -1);
}
