// The contact model of docs/extending.md, which the build extracts and calls `documented_penalty`.
#include <catch2/catch.hpp>

#include "framework/contact/friction_term.hpp"
#include "framework/core/records.hpp"
#include "geometry/errors.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A crate on a floor, `gap` above it; contact acts within 5 mm.
std::string crate(const std::string& gap, const std::string& contact = "", const std::string& more = "") {
  return "gravity: [0, -10, 0]\n"
         "objects:\n"
         "  - {name: floor, shape: {type: box, size: [0.4, 0.1, 0.4], cells: [4, 1, 4]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n"
         "  - {name: crate, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0.013, " + gap + ", 0.017]},\n"
         "     energies: [{type: neo_hookean, young: 10 MPa, poisson: 0.3, density: 1000}], damping: {mass: 20}" + more + "}\n"
         "contact: {distance: 5 mm, model: {type: documented_penalty, stiffness: 1 MPa/m}" + contact + "}\n";
}

}  // namespace

TEST_CASE("the documented contact model has the energy of its formula, and exact derivatives", "[documented][contact_model]") {
  TestScene scene(crate("0.052"));
  World& world = *scene.world;
  VecX x = world.rest;
  world.contact->begin_step({x});
  world.contact->move_to(x);
  // Both faces push with half of their areas; the crate's vertices at 2 mm, the floor's vertex below it.
  const ContactSet& set = world.contact->contacts();
  double area = 0;
  for (const auto& s : set.point_triangle) area += s.weight;
  CHECK(contact_term(world).value(x) == Approx(0.5 * 1e6 * 3e-3 * 3e-3 * area).epsilon(1e-9));
  for (int v = 0; v < x.size() / 3; ++v) x.segment<3>(3 * v) += 1e-4 * Vec3(std::sin(v), std::cos(3 * v), std::sin(2 * v));
  world.contact->move_to(x);
  const VecX gradient = dense_gradient(contact_term(world), x);
  CHECK(gradient.norm() > 1);
  VecX direction = VecX::Zero(x.size());
  for (int i = 0; i < x.size(); ++i) direction(i) = std::cos(i);
  const double h = 1e-7;
  const auto value = [&](double t) {
    const VecX y = x + t * direction;
    world.contact->move_to(y);
    return contact_term(world).value(y);
  };
  CHECK((value(h) - value(-h)) / (2 * h) == Approx(gradient.dot(direction)).epsilon(1e-4));
}

TEST_CASE("with the documented contact model a crate comes to rest on the floor, and friction holds it", "[documented][contact_model]") {
  TestRun run("time: {step: 10 ms, duration: 0.6 s}\n" + crate("0.055", ", friction: {mu: 0.5, eps_v: 1 mm/s}"));
  World& world = *run.world;
  for (int step = 0; step < 60; ++step) run.step();
  REQUIRE(world.friction);
  const VecX forces = contact_term(world).forces(run.state().x, LawTerm::all);
  Vec3 on_crate = Vec3::Zero();
  for (const int v : world.vertices_of(1)) on_crate += vertex(forces, v);
  CHECK(on_crate.y() == Approx(10).epsilon(0.01));
  double normal = 0;
  for_each_record(world.friction->points(), [&](const auto& c) { normal += c.normal_force * std::abs(c.normal.y()); });
  CHECK(normal == Approx(10).epsilon(0.02));
  CHECK(world.contact->smallest_gaps(run.state().x).of_all > 0);
}

TEST_CASE("the documented contact model refuses what it does not have", "[documented][contact_model]") {
  CHECK_THROWS_WITH(TestScene(crate("0.055", ", pairs: [{between: [floor, crate], adhesion: {type: fang, peak_traction: 1 kPa}}]")),
                    Catch::Contains("contact.model: documented_penalty has no adhesion of the gap: it only pushes; take `adhesion` away, or choose model: area_integral"));
}
