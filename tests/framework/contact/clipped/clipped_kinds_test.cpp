// Clipped adhesion within an object, from both sides, of regions, and along surfaces.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/clipped/clipped_adhesion_term.hpp"
#include "framework/contact/points/contact_points.hpp"
#include "geometry/errors.hpp"
#include "tests/support/contact_terms.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"

using namespace tack;

namespace {

const std::string sticks = "adhesion: {type: fang, peak_traction: 2 kPa, peak_distance: 1e-3}";

LawSample sticks_at(double gap) {
  const auto adhesion = bind_component<AdhesionLaw>(parse_string("{type: fang, peak_traction: 2 kPa, peak_distance: 1e-3}", "t"));
  NormalLaw& law = dynamic_cast<NormalLaw&>(*adhesion);
  law.prepare({1e-3, 1e5, 0});
  return law.at(gap);
}

// Two plates of 0.1 m at a gap, the upper one shifted along the first axis.
std::string plates(const std::string& pairs, double shift, double gap, int lower_cells, int upper_cells) {
  const auto plate = [](const char* name, double x, double y, int cells, const char* more) {
    return fmt::format("  - {{name: {}, shape: {{type: box, size: [0.1, 0.01, 0.1], cells: [{}, 1, {}]}}, place: {{translate: [{}, {}, 0]}}, {}}}\n", name, cells, cells, x, y, more);
  };
  return "objects:\n" + plate("lower", 0, -0.005, lower_cells, "motion: [fixed]") +
         plate("upper", shift, 0.005 + gap, upper_cells, "energies: [{type: neo_hookean, young: 1e5}]") +
         "contact: {distance: 1e-3, integral: clipped, pairs: [" + pairs + "]}\n";
}

Vec3 pull_on_upper(World& world) {
  world.participants.begin_step({world.rest});
  world.participants.move_to(world.rest);
  Vec3 sum = Vec3::Zero();
  const VecX force = -dense_gradient(*clipped_adhesion(world), world.rest);
  for (int v = 0; v < world.rest.size() / 3; ++v)
    if (world.body_of(v) == world.body_index("upper")) sum += vertex(force, v);
  return sum;
}

// A strip that is folded once about its middle, with a gap between its two legs.
Vec3 folded(const Vec3& flat, double opening, double thickness) {
  const double radius = opening / 2 + thickness / 2, arc = M_PI * radius, s = flat.x(), depth = flat.y();
  if (std::abs(s) <= arc / 2) return {-(radius + depth) * std::cos(s / radius), (radius + depth) * std::sin(s / radius), flat.z()};
  return {std::abs(s) - arc / 2, (s > 0 ? 1 : -1) * (radius + depth), flat.z()};
}

// Returns the force that pulls the outer half of the upper leg down, over the expected one.
double fold_force(double opening, int cells) {
  constexpr double length = 0.04, width = 0.01, thickness = 4e-3;
  TestScene scene(fmt::format("objects:\n  - {{name: strip, shape: {{type: box, size: [{}, {}, {}], cells: [{}, 2, {}]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n",
                              length, thickness, width, cells, cells / 4) +
                  "contact: {distance: 1e-3, integral: clipped, pairs: [{between: [strip, strip], " + sticks + "}]}\n");
  World& world = *scene.world;
  VecX x = world.rest;
  for (int v = 0; v < world.rest.size() / 3; ++v) vertex(x, v) = folded(vertex(world.rest, v), opening, thickness);
  world.participants.begin_step({x});
  world.participants.move_to(x);
  const VecX force = -dense_gradient(*clipped_adhesion(world), x);
  // Half way between two rows of vertices.
  const double counted = (std::floor(cells / 4.0) + 0.5) * length / cells;
  double pull = 0;
  for (int v = 0; v < world.rest.size() / 3; ++v)
    if (vertex(world.rest, v).x() > length / 2 - counted) pull -= vertex(force, v).y();
  return pull / (counted * width * sticks_at(opening).slope);
}

}  // namespace

TEST_CASE("clipped adhesion: a folded strip adheres to itself, whatever its elements", "[clipped]") {
  for (const int cells : {20, 28, 40, 56})
    for (const double opening : {0.4e-3, 1.3e-3}) {
      INFO(cells << " cells, opening " << opening);
      CHECK(fold_force(opening, cells) == Approx(1).epsilon(0.01));
    }
}

TEST_CASE("clipped adhesion: a body alone has no energy, however small its elements", "[clipped]") {
  for (const int cells : {3, 12}) {
    TestScene scene(fmt::format("objects:\n  - {{name: cube, shape: {{type: box, size: [8e-3, 8e-3, 8e-3], cells: [{0}, {0}, {0}]}}, energies: [{{type: neo_hookean, young: 1e5}}]}}\n", cells) +
                    "contact: {distance: 1e-3, integral: clipped, pairs: [{between: [cube, cube], " + sticks + "}]}\n");
    World& world = *scene.world;
    world.participants.begin_step({world.rest});
    world.participants.move_to(world.rest);
    CHECK(clipped_adhesion(world)->value(world.rest) == 0);
  }
}

TEST_CASE("clipped adhesion: both sides together pull as one", "[clipped]") {
  for (const double shift : {0.0, 0.023})
    for (const auto& [lower, upper] : {std::pair{1, 1}, {4, 5}, {2, 9}}) {
      INFO("shift " << shift << ", " << lower << " and " << upper << " cells");
      TestScene both(plates("{between: [lower, upper], integrate: both, " + sticks + "}", shift, 0.7e-3, lower, upper));
      const Vec3 force = pull_on_upper(*both.world);
      CHECK(force.y() == Approx(-0.1 * (0.1 - shift) * sticks_at(0.7e-3).slope).epsilon(1e-4));
      CHECK(force.x() == Approx(shift > 0 ? 0.1 * sticks_at(0.7e-3).value : 0.0).epsilon(1e-3).margin(1e-4 * 0.1 * std::abs(sticks_at(0.7e-3).value)));
    }
}

TEST_CASE("clipped adhesion: regions have their laws", "[clipped]") {
  const std::string strong = "adhesion: {type: fang, peak_traction: 6 kPa, peak_distance: 1e-3}";
  const auto half = [](const char* object, const char* axis) { return fmt::format("{{object: {}, select: {{type: formula, where: '{} < 1e-6'}}}}", object, axis); };
  const double whole = -0.01 * sticks_at(0.7e-3).slope;
  for (const std::array<int, 2> cells : {std::array{4, 4}, std::array{4, 6}, std::array{10, 4}}) {
    INFO(cells[0] << " and " << cells[1] << " cells");
    const auto force = [&](const std::string& pairs) {
      TestScene scene(plates(pairs, 0, 0.7e-3, cells[0], cells[1]));
      return pull_on_upper(*scene.world).y();
    };
    const std::string all = "{between: [lower, upper], " + sticks + "}", left = half("lower", "x");
    CHECK(force("{between: [" + left + ", upper], " + sticks + "}") == Approx(0.5 * whole).epsilon(1e-4));
    CHECK(force("{between: [upper, " + left + "], " + sticks + "}") == Approx(0.5 * whole).epsilon(1e-4));
    CHECK(force("{between: [" + left + ", " + half("upper", "z") + "], " + sticks + "}") == Approx(0.25 * whole).epsilon(1e-4));
    CHECK(force(all + ", {between: [" + left + ", upper], " + strong + "}") == Approx(2 * whole).epsilon(1e-4));
    CHECK(force(all + ", {between: [" + left + ", upper], friction: {mu: 0.1}}") == Approx(0.5 * whole).epsilon(1e-4));
  }
}

TEST_CASE("clipped adhesion: the interface of regions has the force of a boundary", "[clipped]") {
  const double shift = 0.0123;
  TestScene scene(plates("{between: [{object: lower, select: {type: formula, where: 'x < 1e-6'}}, upper], " + sticks + "}", shift, 0.7e-3, 4, 5));
  World& world = *scene.world;
  const Vec3 force = pull_on_upper(world);
  const double work = 0.1 * sticks_at(0.7e-3).value;
  // The upper plate covers the region from its own boundary at the left to the interface.
  CHECK(force.y() == Approx(-0.1 * (0.05 - shift) * sticks_at(0.7e-3).slope).epsilon(1e-4));
  CHECK(force.x() == Approx(work).epsilon(1e-3));
}

TEST_CASE("clipped adhesion: contact points cover the overlap and carry no pressure", "[clipped]") {
  for (const double shift : {0.0, 0.023}) {
    TestScene scene(plates("{between: [lower, upper], tangential_adhesion: {mu: 0.5}, " + sticks + "}", shift, 1.4e-3, 4, 5));
    World& world = *scene.world;
    world.participants.begin_step({world.rest});
    world.participants.move_to(world.rest);
    double area = 0;
    for_each_record(contact_points({*world.contact, integrated_laws(world.contact->pairs(), 0, 1), world.rest}), [&](const auto& c) {
      area += c.area;
      CHECK(c.normal_force == 0);
      CHECK(c.gap == Approx(1.4e-3));
      Vec3 separation = Vec3::Zero();
      double sum = 0;
      for (std::size_t i = 0; i < c.vertices.size(); ++i) {
        separation += c.coefficients[i] * vertex(world.rest, c.vertices[i]);
        sum += c.coefficients[i];
      }
      CHECK((separation - c.gap * c.normal).norm() < 1e-12);
      CHECK(std::abs(sum) < 1e-12);
    });
    CHECK(area == Approx(0.1 * (0.1 - shift)).epsilon(1e-4));
  }
}
