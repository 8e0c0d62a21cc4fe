// Volumes, affine bodies, sheets, rods and particles in pairs: a stated traction acts on the
// overlapping area, width or cross-section, whatever the meshes; and nothing tunnels.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <cmath>
#include <random>

#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/area_integral/rod_overlaps.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/contact_terms.hpp"

using namespace tack;

namespace {

constexpr double side = 0.1, rod_length = 0.08, radius = 1e-3, peak = 1000, dhat = 1e-4;  // m, m, m, Pa, m

enum class ObjectKind { volume, affine, sheet, rod, particles };
const std::vector<ObjectKind> kinds = {ObjectKind::volume, ObjectKind::affine, ObjectKind::sheet, ObjectKind::rod, ObjectKind::particles};

bool codimensional(ObjectKind kind) { return kind == ObjectKind::rod || kind == ObjectKind::particles; }

std::string name_of(ObjectKind kind) {
  return std::vector<std::string>{"volume", "affine", "sheet", "rod", "particles"}[static_cast<size_t>(kind)];
}

// Returns shape, size and material, without braces, with the centre at y = 0. Particles that meet rods lie in a row along x.
std::string described(ObjectKind kind, int cells, bool in_a_row = false) {
  switch (kind) {
    case ObjectKind::volume:
      return fmt::format("shape: {{type: box, size: [{0}, 0.01, {0}], cells: [{1}, 1, {1}]}}, "
                         "energies: [{{type: neo_hookean, young: 1e6, poisson: 0.3, density: 1000}}]", side, cells);
    case ObjectKind::affine:
      return fmt::format("shape: {{type: box, size: [{0}, 0.01, {0}], cells: [{1}, 1, {1}]}}, body: affine", side, cells);
    case ObjectKind::sheet:
      return fmt::format("shape: {{type: grid, size: [{0}, {0}], cells: [{1}, {1}]}}, shell: {{thickness: 1 mm}}, "
                         "energies: [{{type: stvk_membrane, young: 1e6, poisson: 0.3, density: 1000}}, "
                         "{{type: hinge_bending, young: 1e6, poisson: 0.3}}]", side, cells);
    case ObjectKind::rod:
      return fmt::format("shape: {{type: segment, length: {}, edges: {}}}, rod: {{radius: {}}}, "
                         "energies: [{{type: elastic_rod, young: 1e7, density: 1000}}]", rod_length, 2 * cells, radius);
    case ObjectKind::particles:
      break;
  }
  return fmt::format("shape: {{type: points, {}}}, particle: {{radius: {}}}, energies: [{{type: particle, density: 2000}}]",
                     in_a_row ? "size: [0.06, 0, 0], counts: [4, 1, 1]" : "size: [0.06, 0, 0.06], counts: [4, 1, 4]", radius);
}

double half_height(ObjectKind kind) { return kind == ObjectKind::volume || kind == ObjectKind::affine ? 0.005 : 0; }

struct Pairing {
  ObjectKind lower, upper;
  int lower_cells = 4, upper_cells = 5;
  double gap = dhat, offset = 0, angle = 90;  // m, m, degrees by which a rod over a rod is turned
  std::string integrate = "automatic";

  std::string yaml() const {
    const double y = half_height(lower) + half_height(upper) + 2 * offset + gap;
    return fmt::format("objects:\n"
                       "  - {{name: lower, {}, contact_offset: {}}}\n"
                       "  - {{name: upper, {}, contact_offset: {}, place: {{axis: [0, 1, 0], angle: {} deg, translate: [0, {}, 0]}}}}\n"
                       "contact:\n  distance: {}\n"
                       "  pairs: [{{between: [lower, upper], integrate: {}, adhesion: {{type: fang, young: 1e4, critical_strain: 0.1}}}}]\n",
                       described(lower, lower_cells, upper == ObjectKind::rod), offset,
                       described(upper, upper_cells, lower == ObjectKind::rod), offset,
                       lower == ObjectKind::rod && upper == ObjectKind::rod ? angle : 0.0, y, dhat, integrate);
  }

  // Returns the opposite area [m^2].
  double measure() const {
    const auto is = [&](ObjectKind a, ObjectKind b) { return (lower == a && upper == b) || (lower == b && upper == a); };
    const double disc = M_PI * radius * radius, width = 2 * radius;
    if (is(ObjectKind::rod, ObjectKind::rod)) return angle == 0 ? width * rod_length : width * width / std::sin(angle * M_PI / 180);
    if (lower == ObjectKind::particles || upper == ObjectKind::particles) return (codimensional(lower) && lower != upper && codimensional(upper) ? 4 : 16) * disc;
    return codimensional(lower) || codimensional(upper) ? width * rod_length : side * side;
  }
};

// Returns the pull at the gap of the peak traction [N].
double pull(const Pairing& pairing) {
  TestScene scene(pairing.yaml());
  World& world = *scene.world;
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  const ObjectPair pair{world.body_index("lower"), world.body_index("upper")};
  const Vec3 force = contact_term(world).force_between(world.rest, LawTerm::adhesion, pair);
  CHECK(std::abs(force.x()) + std::abs(force.z()) <= 1e-9 * force.norm());
  return force.y();
}

}  // namespace

TEST_CASE("a traction acts on the opposite area, between all kinds of objects", "[contact][all_pairs]") {
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds)
      for (const auto& [m, n] : {std::pair{4, 5}, std::pair{9, 7}})
        for (const double offset : {0.0, 5e-4})
          for (const std::string integrate : {"automatic", "lower", "upper", "both"}) {
            const Pairing pairing{a, b, m, n, dhat, offset, 90, integrate};
            INFO(name_of(a) << " " << name_of(b) << " " << m << " " << n << " " << offset << " " << integrate);
            CHECK(pull(pairing) == Approx(peak * pairing.measure()).epsilon(0.01));
          }
}

TEST_CASE("rods carry the overlap of their projections, at any angle and mesh", "[contact][all_pairs]") {
  for (const double angle : {0.0, 5.0, 20.0, 45.0, 90.0, 135.0})
    for (const auto& [m, n] : {std::pair{2, 3}, std::pair{7, 40}, std::pair{60, 60}}) {
      const Pairing pairing{ObjectKind::rod, ObjectKind::rod, m, n, dhat, 0, angle};
      INFO(angle << " " << m << " " << n);
      CHECK(pull(pairing) == Approx(peak * pairing.measure()).epsilon(0.01));
    }
}

TEST_CASE("the resultant of a law does not depend on offsets, which only move where it acts", "[contact][all_pairs]") {
  for (const ObjectKind a : kinds)
    for (const double gap : {0.4e-4, 0.8e-4, 1.5e-4}) {
      const double without = pull({a, ObjectKind::volume, 4, 5, gap, 0}), with = pull({a, ObjectKind::volume, 4, 5, gap, 3e-4});
      INFO(name_of(a) << " " << gap);
      CHECK(with == Approx(without).epsilon(1e-6));
    }
}

namespace {

// A body thrown down at 10 m/s, more than its distance in a step, and along the fixed one.
std::string thrown(ObjectKind lower, ObjectKind upper) {
  const auto body = [](ObjectKind kind, int points) -> std::string {
    switch (kind) {
      case ObjectKind::rod:  // threads 20 mm apart: with the offsets, nothing fits between them
        return "shape: {type: net, size: [0.1, 0.1], cells: [5, 5], edges: 2}, rod: {radius: 1 mm}, contact_offset: 4 mm, "
               "energies: [{type: elastic_rod, young: 1e8, density: 1000}]";
      case ObjectKind::particles:
        return fmt::format("shape: {{type: points, size: [{0}, 0, {0}], counts: [{1}, 1, {1}]}}, particle: {{radius: 9 mm}}, "
                           "contact_offset: 9 mm, energies: [{{type: particle, density: 1000}}]", 0.025 * (points - 1), points);
      default: return described(kind, 4) + ", contact_offset: 0.5 mm";
    }
  };
  return fmt::format("time: {{step: 10 ms, duration: 1}}\ngravity: [0, -9.81, 0]\nobjects:\n"
                     "  - {{name: lower, {}, motion: [fixed]}}\n"
                     "  - {{name: upper, {}, place: {{translate: [0.003, 0.06, 0.002]}}, velocity: [0.5, -10, 0.2]}}\n"
                     "contact: {{distance: 1e-3, friction: {{mu: 0.3, eps_v: 0.05}}}}\n",
                     body(lower, 10), body(upper, 4));
}

}  // namespace

TEST_CASE("no object passes another at 10 m/s in steps of 10 ms, between all kinds of objects", "[contact][all_pairs]") {
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds) {
      INFO(name_of(a) << " below " << name_of(b));
      TestRun run(thrown(a, b));
      for (int i = 0; i < 6; ++i) {
        const StepReport report = run.step();
        CHECK(report.min_distance > 0);
        CHECK(report.intersections == 0);
      }
      const int lower = run.world->body_index("lower"), upper = run.world->body_index("upper");
      CHECK(run.world->centre_of_mass(upper, run.state().x).y() > run.world->centre_of_mass(lower, run.state().x).y());
    }
}

TEST_CASE("contact between all kinds of objects has the derivatives of its value", "[contact][all_pairs]") {
  for (const ObjectKind a : kinds)
    for (const ObjectKind b : kinds)
      for (const double offset : {0.0, 5e-4}) {
        INFO(name_of(a) << " " << name_of(b) << " " << offset);
        TestScene scene(Pairing{a, b, 3, 4, 0.6e-4, offset, 70}.yaml());
        World& world = *scene.world;
        world.contact->begin_step({world.rest});
        const auto value = [&](const VecX& y) { return world.contact->move_to(y), contact_term(world).value(y); };
        const auto slope = [&](const VecX& y) { return world.contact->move_to(y), dense_gradient(contact_term(world), y); };
        // Along a random direction.
        std::mt19937 random(7);
        std::uniform_real_distribution<double> component(-1, 1);
        VecX direction(world.rest.size());
        for (double& w : direction) w = component(random);
        const double step = 1e-9;
        const VecX x = world.rest + 1e-5 * direction;
        const VecX g = slope(x);
        CHECK((value(x + step * direction) - value(x - step * direction)) / (2 * step) == Approx(g.dot(direction)).epsilon(1e-4));
        const VecX change = (slope(x + step * direction) - slope(x - step * direction)) / (2 * step);
        const VecX product = [&]() -> VecX { world.contact->move_to(x); return dense_hessian(contact_term(world), x, Projection::none) * direction; }();
        CHECK((change - product).norm() <= 1e-4 * product.norm());
      }
}

TEST_CASE("projections of rods and particles overlap as rectangles and discs do", "[contact][all_pairs]") {
  Vec3 centre;
  const std::array<Vec3, 2> a{Vec3(-1, 0, 0), Vec3(1, 0, 0)};
  // Segments that cross at right angles; side by side with a shift; one past the end of the other.
  CHECK(projected_overlap(a, 0.2, {Vec3(0.5, 1, -1), Vec3(0.5, 1, 1)}, 0.3, Vec3::UnitY(), centre) == Approx(0.06));
  CHECK((centre - Vec3(0.5, 0, 0)).norm() <= 1e-12);
  CHECK(projected_overlap(a, 0.2, {Vec3(0, 1, 0.1), Vec3(3, 1, 0.1)}, 0.2, Vec3::UnitY(), centre) == Approx(0.1));
  CHECK(projected_overlap(a, 0.2, {Vec3(1.5, 1, 0), Vec3(3, 1, 0)}, 0.2, Vec3::UnitY(), centre) == 0);
  const double turned = M_PI / 6;
  CHECK(projected_overlap(a, 0.2, {Vec3(-std::cos(turned), 1, -std::sin(turned)), Vec3(std::cos(turned), 1, std::sin(turned))}, 0.1,
                       Vec3::UnitY(), centre) == Approx(0.02 / std::sin(turned)));
  CHECK(disc_overlap(2, 10) == Approx(4 * M_PI));
  CHECK(disc_overlap(2, 1e-3) == Approx(4e-3).epsilon(1e-4));
  CHECK(disc_overlap(1, 1) == Approx(std::sqrt(3) / 2 + M_PI / 3));
}

TEST_CASE("a rod over the kink of another rod carries one overlap, as it slides over it and as it bends", "[contact][all_pairs]") {
  const double gap = 3 * radius;
  TestScene scene(fmt::format("objects:\n  - {{name: lower, {}}}\n  - {{name: upper, {}, place: {{axis: [0, 1, 0], angle: 90 deg, translate: [0, {}, 0]}}}}\n"
                              "contact:\n  distance: 1e-5\n  pairs: [{{between: [lower, upper], adhesion: {{type: fang, peak_traction: 1000, "
                              "peak_distance: {}, range: {}}}}}]\n",
                              described(ObjectKind::rod, 1), described(ObjectKind::rod, 1), gap, gap, 2 * gap));
  World& world = *scene.world;
  const Body &below = world.bodies[world.body_index("lower")], &above = world.bodies[world.body_index("upper")];
  const Vec3 along = (vertex(world.rest, above.first_vertex + 2) - vertex(world.rest, above.first_vertex)).normalized();
  // In J. The upper rod bends in its middle vertex by an angle [rad], towards the lower one if it is above zero; the lower one
  // is shifted from below that vertex.
  const auto energy = [&](double angle, double shift) {
    VecX x = world.rest;
    for (int v = 0; v < above.vertex_count; ++v)
      vertex(x, above.first_vertex + v).y() -= std::abs(vertex(x, above.first_vertex + v).dot(along)) * std::tan(angle / 2);
    for (int v = 0; v < below.vertex_count; ++v) vertex(x, below.first_vertex + v) += shift * along;
    world.contact->begin_step({x});
    world.contact->move_to(x);
    return contact_term(world).term_value(x, LawTerm::adhesion);
  };
  const double straight = energy(0, 0);
  CHECK(straight < 0);
  for (const double tiny : {-1e-8, 1e-8})
    for (const double shift : {0.0, 1e-9, 2e-5}) CHECK(energy(tiny, shift) == Approx(straight).epsilon(1e-6));
  // Nearer by d (1 - cos) only.
  const double degree = M_PI / 180;
  CHECK(energy(2 * degree, 0) == Approx(straight).epsilon(2e-3));
  CHECK(energy(10 * degree, 0) == Approx(straight).epsilon(2e-2));
  // Without a jump where a second nearest point comes up.
  for (const double angle : {2 * degree, 10 * degree}) {
    double last = energy(angle, 0);
    for (int i = 1; i <= 400; ++i) {
      const double next = energy(angle, i * 2e-6);
      CHECK(std::abs(next - last) <= 1e-3 * std::abs(straight));
      last = next;
    }
  }
}

TEST_CASE("a start within the offsets is reported with its positions", "[contact][all_pairs]") {
  CHECK_THROWS_WITH(TestScene("objects:\n"
                              "  - {name: net, " + described(ObjectKind::rod, 4) + ", contact_offset: 2 mm, motion: [fixed]}\n"
                              "  - {name: cube, " + described(ObjectKind::affine, 2) + ", place: {translate: [0, 0.0065, 0]}}\n"
                              "contact: {distance: 1e-3}\n"),
                    Catch::Contains("violates the contact offsets") && Catch::Contains("'net'") && Catch::Contains("'cube'") &&
                        Catch::Contains("0.0015 m apart, and need 0.002 m"));
}
