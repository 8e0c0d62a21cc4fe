// Probes of touching surfaces, against exact values for blocks with prescribed motion.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/output/probe.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

// Two blocks on a floor, `gap` above it; they adhere within 2 mm.
std::string blocks(double gap, const char* floor_keys = "") {
  const auto block = [&](const char* name, double x) {
    return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [3, 1, 3]}},\n"
                       "     place: {{translate: [{}, {}, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n",
                       name, x, 0.05 + gap);
  };
  return "objects:\n"
         "  - {name: floor, shape: {type: box, size: [1, 0.1, 1], cells: [5, 1, 4]},\n"
         "     place: {translate: [0, -0.05, 0]}, motion: [fixed]" + std::string(floor_keys) + "}\n" +
         block("left", -0.1) + block("right", 0.15) +
         "contact:\n  distance: 1e-3\n"
         "  pairs:\n"
         "    - {between: [left, floor], adhesion: {type: fang, young: 1e4, critical_strain: 0.1}}\n"
         "    - {between: [right, floor], friction: {mu: 0.5, eps_v: 0.1}}\n";
}

struct Probed {
  explicit Probed(double gap, const char* floor_keys = "") : scene(blocks(gap, floor_keys)) {
    state = world().start;
    state.x_before = state.x;
    state.h_before = 0.01;
    world().contact->begin_step({state.x});
    world().contact->move_to(state.x);
  }
  World& world() { return *scene.world; }
  std::vector<double> sample(const std::string& yaml) {
    const auto probe = component<Probe>(yaml);
    probe->prepare(world());
    return probe->sample(world(), state);
  }
  void shift(const char* name, const Vec3& by) {
    const Body& body = world().bodies[world().body_index(name)];
    for (int v = 0; v < body.vertex_count; ++v) vertex(state.x, body.first_vertex + v) += by;
    world().contact->move_to(state.x);
  }

  TestScene scene;
  State state;
};

const std::string left_speed = "{type: sliding_speed, name: s, between: [floor, left]}";
const std::string attached = "{type: attached_objects, name: n, to: floor}";

}  // namespace

TEST_CASE("sliding_speed: the slip of the last step over the step size", "[friction]") {
  Probed p(0.5e-3);
  CHECK(p.sample(left_speed) == std::vector<double>{0});
  p.shift("left", Vec3(3e-4, -1e-5, 4e-4));  // the approach does not count
  CHECK(p.sample(left_speed)[0] == Approx(5e-4 / 0.01).epsilon(1e-6));
  CHECK(p.sample("{type: sliding_speed, name: s, between: [right, floor]}")[0] == Approx(0).margin(1e-15));
  CHECK(p.sample("{type: sliding_speed, name: s, between: [right, left]}")[0] == 0);
  p.shift("left", Vec3(0, 0.01, 0));
  CHECK(p.sample(left_speed)[0] == 0);  // out of reach
}

TEST_CASE("attached_objects: objects within the range of adhesion", "[friction]") {
  CHECK(Probed(1.5e-3).sample(attached) == std::vector<double>{1});  // only the left block adheres
  CHECK(Probed(0.5e-3).sample(attached) == std::vector<double>{1});
  CHECK(Probed(2.5e-3).sample(attached) == std::vector<double>{0});
  CHECK(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: left}") == std::vector<double>{1});
  CHECK(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: right}") == std::vector<double>{0});
  CHECK(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: floor, of: [left]}") == std::vector<double>{1});
  CHECK(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: floor, of: [right]}") == std::vector<double>{0});
  CHECK(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: floor, of: [right, left]}") == std::vector<double>{1});
  CHECK_THROWS_AS(Probed(1.5e-3).sample("{type: attached_objects, name: n, to: floor, of: [middle]}"), InputError);
  const auto at = [](const char* face) { return Probed(1.5e-3).sample(std::string("{type: attached_objects, name: n, to: left, select: {type: face, direction: ") + face + "}}")[0]; };
  CHECK(at("[0, -1, 0]") == 1);  // the floor is below the block
  CHECK(at("[0, 1, 0]") == 0);
}

TEST_CASE("attached_objects: a finer contact surface belongs to what is selected", "[friction]") {
  // The blocks lie within triangles of the floor, far from its vertices.
  for (const char* keys : {", surface: {edge_length: 0.02}", ""}) {
    Probed p(1.5e-3, keys);
    p.shift("left", Vec3(0.1, 0, 0.12));
    CHECK(p.sample(attached) == std::vector<double>{1});
    CHECK(p.sample("{type: attached_objects, name: n, to: floor, select: {type: face, direction: [0, 1, 0]}}") == std::vector<double>{1});
    CHECK(p.sample("{type: attached_objects, name: n, to: floor, select: {type: face, direction: [0, -1, 0]}}") == std::vector<double>{0});
  }
}

TEST_CASE("friction_force: mu N against the sliding direction, equal and opposite on both bodies", "[friction]") {
  Probed p(0.5e-3);
  p.world().friction->begin_step({p.state.x, 0, 0.01});
  p.world().friction->lag(p.state.x);
  const double pressing =
      p.sample("{type: contact_force, name: n, on: right, from: floor, direction: [0, 1, 0]}")[0];
  p.shift("right", Vec3(0, 0, -0.02));
  const auto on_right = p.sample("{type: friction_force, name: f, on: right, from: floor}");
  const auto on_floor = p.sample("{type: friction_force, name: f, on: floor}");
  REQUIRE(on_right.size() == 3);
  CHECK(pressing > 0);
  CHECK(on_right[2] == Approx(0.5 * pressing).epsilon(1e-9));
  CHECK(std::abs(on_right[0]) + std::abs(on_right[1]) <= 1e-9 * pressing);
  CHECK(on_floor[2] == Approx(-on_right[2]).epsilon(1e-12));
  CHECK(p.sample("{type: friction_force, name: f, on: right, part: adhesion, direction: [0, 0, 1]}")[0] == 0);
  CHECK_THROWS_AS(p.sample("{type: friction_force, name: f, on: nothing}"), InputError);
}

TEST_CASE("contact_area: the area of overlap within the range of each law") {
  const auto area = [](Probed& p, const char* object, const char* part) {
    return p.sample(fmt::format("{{type: contact_area, name: a, between: [{}, floor], part: {}}}", object, part))[0];
  };
  Probed close(0.5e-3), apart(1.5e-3), away(3e-3);
  CHECK(area(close, "left", "all") == Approx(0.01));
  CHECK(area(close, "left", "barrier") == Approx(0.01));
  CHECK(area(close, "left", "adhesion") == Approx(0.01));
  CHECK(area(close, "right", "all") == Approx(0.01));
  CHECK(area(close, "right", "adhesion") == 0);
  CHECK(area(apart, "left", "all") == Approx(0.01));
  CHECK(area(apart, "left", "barrier") == 0);
  CHECK(area(apart, "right", "all") == 0);
  CHECK(area(away, "left", "all") == 0);
}
