// Magnitudes of lagged contacts: they add up to the normal force and to the area, whatever the meshes.
#include "framework/contact/lagged_contacts.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <fstream>

#include "framework/contact/contact_term.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/silence.hpp"

using namespace tack;

namespace {

// A plate of 0.1 m x 0.1 m on a larger one, 0.7 mm apart.
std::string plates(int upper_cells, int lower_cells, const std::string& weights) {
  return fmt::format(
      "objects:\n"
      "  - {{name: lower, shape: {{type: box, size: [0.16, 0.01, 0.16], cells: [{0}, 1, {0}]}},\n"
      "     place: {{translate: [0.003, -0.005, 0.002]}}, motion: [fixed]}}\n"
      "  - {{name: upper, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [{1}, 1, {1}]}},\n"
      "     place: {{translate: [0, 0.0057, 0]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
      "contact:\n  distance: 1e-3\n  weights: {2}\n  barrier: {{type: clamped_log, stiffness: 1e3}}\n"
      "  pairs: [{{between: [upper, lower], integrate: upper, friction: {{mu: 0.5}},\n"
      "    adhesion: {{type: fang, young: 1e3, critical_strain: 0.1}}}}]\n",
      lower_cells, upper_cells, weights);
}

struct Sums {
  double force = 0, area = 0;
  int contacts = 0;
};
Sums sums(const LaggedContacts& contacts) {
  Sums s;
  const auto add = [&](const auto& list) {
    for (const auto& c : list) {
      s.force += c.normal_force;
      s.area += c.area;
      ++s.contacts;
      CHECK(c.normal_force >= 0);
      double sum = 0;
      for (const double k : c.coefficients) sum += k;
      CHECK(std::abs(sum) <= 1e-12);
      CHECK((c.tangents.transpose() * c.tangents - Eigen::Matrix2d::Identity()).norm() <= 1e-12);
    }
  };
  add(contacts.twos);
  add(contacts.threes);
  add(contacts.fours);
  return s;
}

LaggedContacts lag(const World& world, const VecX& x) {
  const std::vector<char> all(world.contact->pairs().laws().size(), 1);
  return lag_contacts({*world.contact, world.contact_term->laws(LawPart::barrier), all, x});
}

}  // namespace

TEST_CASE("lagged contacts: the forces add up to the barrier's, the areas to the area", "[friction]") {
  for (const int upper : {2, 5, 8}) {
    for (const int lower : {1, 4, 11}) {
      INFO("cells " << upper << " on " << lower);
      TestScene scene(plates(upper, lower, "area"));
      World& world = *scene.world;
      world.contact->begin_step({world.rest});
      world.contact->move_to(world.rest);
      const Sums s = sums(lag(world, world.rest));
      const double pressing = world.contact_term->force_between(world.rest, LawPart::barrier, {1, 0}).y();
      CHECK(pressing > 0);
      CHECK(s.force == Approx(pressing).epsilon(1e-9));
      CHECK(s.area == Approx(0.01).epsilon(1e-6));
      CHECK(s.contacts == (upper + 1) * (upper + 1));  // one per point, whatever it sees
    }
  }
}

// Plain sums count area several times; friction follows the forces that they give. Those of a few pairs of
// edges lean.
TEST_CASE("lagged contacts: the forces of plain sums add up too", "[friction]") {
  TestScene scene(plates(5, 4, "pair"));
  World& world = *scene.world;
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  const double pressing = world.contact_term->force_between(world.rest, LawPart::barrier, {1, 0}).y();
  CHECK(sums(lag(world, world.rest)).force == Approx(pressing).epsilon(1e-3));
}

// The floor's points see the facets, edges and vertices of the ball, with weights of both signs; their
// normals differ by a little.
TEST_CASE("lagged contacts: the forces of a ball on a floor add up", "[friction]") {
  TestScene scene(
      "objects:\n"
      "  - {name: floor, shape: {type: box, size: [0.06, 0.01, 0.06], cells: [60, 1, 60]},\n"
      "     place: {translate: [0.0003, -0.005, 0.0002]}, motion: [fixed]}\n"
      "  - {name: ball, shape: {type: sphere, radius: 0.1, cells: 16}, place: {translate: [0, 0.1004, 0]},\n"
      "     energies: [{type: neo_hookean, young: 1e5}]}\n"
      "contact: {distance: 1e-3, friction: {mu: 0.5}}\n");
  World& world = *scene.world;
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  const Vec3 pressing = world.contact_term->force_between(world.rest, LawPart::barrier, {1, 0});
  const Sums s = sums(lag(world, world.rest));
  CHECK(s.contacts > 20);
  CHECK(s.force == Approx(pressing.y()).epsilon(0.01));
}

// The four lower corners of a blade in a groove: its walls are two contacts if it is steep, one if it is
// nearly flat.
TEST_CASE("lagged contacts: features whose normals agree are one contact", "[friction]") {
  const auto contacts_in_groove = [](double steepness) {
    const TemporaryFolder folder;
    const auto file = folder.path() / "groove.obj";
    std::ofstream(file) << fmt::format(
        "v -0.1 {0} -0.1\nv -0.1 {0} 0.1\nv 0 0 -0.1\nv 0 0 0.1\nv 0.1 {0} -0.1\nv 0.1 {0} 0.1\n"
        "f 1 2 3\nf 2 4 3\nf 3 4 5\nf 4 6 5\n", 0.1 * steepness);
    const double gap = 5e-4 * std::hypot(1, steepness);  // above the bottom line: 0.5 mm from both walls
    TestScene scene(fmt::format(
        "objects:\n"
        "  - {{name: groove, shape: {{type: file, path: {}}}, motion: [fixed]}}\n"
        "  - {{name: blade, shape: {{type: box, size: [1e-4, 0.01, 0.01]}},\n"
        "     place: {{translate: [0, {}, 0.003]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n"
        "contact: {{distance: 1e-3, guard: 0.01, friction: {{mu: 0.5}},\n"
        "  pairs: [{{between: [blade, groove], integrate: blade}},\n"
        "          {{between: [blade, blade], contact: false}}]}}\n", file.string(), 0.005 + gap));
    World& world = *scene.world;
    world.contact->begin_step({world.rest});
    world.contact->move_to(world.rest);
    const Sums s = sums(lag(world, world.rest));
    CHECK(s.force > 0);
    return s.contacts;
  };
  CHECK(contacts_in_groove(2) == 8);
  CHECK(contacts_in_groove(0.1) == 4);
}
