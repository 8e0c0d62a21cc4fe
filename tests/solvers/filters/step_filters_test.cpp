#include <catch2/catch.hpp>

#include <Eigen/LU>

#include "framework/contact/contact_system.hpp"
#include "framework/core/step_filter.hpp"
#include "geometry/ccd/accd.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

double largest_step(const std::string& filter, World& world, const VecX& x, const VecX& p, double t_max = 1) {
  PhaseClock clock;
  const auto f = Registry<StepFilter>::make(filter);
  const FeasibilityContext context{world.contact.get(), world.tets, clock};
  REQUIRE(f->attach(context));
  return f->largest_step(x, p, t_max);
}

// A small box 1 cm above a thin sheet.
struct Fall {
  TestScene scene{
      "objects:\n"
      "  - {name: sheet, shape: {type: grid, size: [0.5, 0.5], cells: [3, 3]}, motion: [fixed]}\n"
      "  - {name: box, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {axis: [1, 0.3, 2], angle: 0.4,\n"
      "     translate: [0.02, 0.1, 0.01]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
      "contact: {distance: 1 mm}\n"};
  World& world = *scene.world;
  VecX x = world.rest;
  double gap = (world.contact->move_to(x), world.contact->smallest_gaps(x).of_all);

  VecX motion(const Vec3& d) const {
    VecX p = VecX::Zero(x.size());
    for (int b = 0; b < world.dofs.block_count(); ++b) vertex(p, world.dofs.vertex_of_block(b)) = d;
    return p;
  }
  bool intersects(const VecX& y) const {
    return !find_intersections(world.contact->surface().mesh, y, world.contact->colliding(), 1).empty();
  }
};

// The signed volume of a tet, six times.
double volume(const VecX& x, const Tet& t) {
  Mat3 edges;
  for (int k = 0; k < 3; ++k) edges.col(k) = vertex(x, t[k + 1]) - vertex(x, t[0]);
  return edges.determinant();
}

}  // namespace

TEST_CASE("ccd stops a fast body before a thin sheet", "[filters]") {
  Fall fall;
  const double height = fall.world.rest(1);  // of the sheet
  double lowest = 1e9;
  for (int b = 0; b < fall.world.dofs.block_count(); ++b)
    lowest = std::min(lowest, vertex(fall.x, fall.world.dofs.vertex_of_block(b)).y() - height);
  for (const double speed : {0.2, 1.0, 30.0}) {
    INFO("speed " << speed);
    const VecX p = fall.motion({0.01, -speed, 0.005});
    const double t = largest_step("ccd", fall.world, fall.x, p);
    CHECK(t < 1);
    CHECK(t * speed < lowest);           // it does not arrive
    CHECK(t * speed > 0.8 * lowest);     // and is not stopped long before
    for (int i = 0; i <= 200; ++i) REQUIRE_FALSE(fall.intersects(fall.x + t * i / 200.0 * p));
    CHECK(fall.intersects(fall.x + lowest * 1.05 / speed * p));  // it would have
  }
}

TEST_CASE("ccd does not stop bodies that separate, slide or rest", "[filters]") {
  Fall fall;
  CHECK(largest_step("ccd", fall.world, fall.x, fall.motion({0, 5, 0})) == 1);
  CHECK(largest_step("ccd", fall.world, fall.x, fall.motion({3, 0, 1})) == 1);
  CHECK(largest_step("ccd", fall.world, fall.x, fall.motion(Vec3::Zero())) == 1);
  CHECK(largest_step("ccd", fall.world, fall.x, fall.motion({0, -1, 0}), 1e-3) == 1e-3);
}

TEST_CASE("inversion: no tet loses more than the allowed volume, and no step is truncated without need", "[filters]") {
  const TetBody box(Vec3(1, 1, 1), {1, 1, 1});
  World world;
  RandomMotions random(5);
  int cut = 0;
  for (int trial = 0; trial < 2000; ++trial) {
    world.tets = {box.body.tets[static_cast<size_t>(trial) % box.body.tets.size()]};
    const Tet& tet = world.tets[0];
    const VecX x = box.rest + 0.1 * random.vectors(box.rest.size());
    const VecX p = std::pow(10.0, random.uniform(-1.5, 1.5)) * random.vectors(x.size());
    const double t = largest_step("inversion", world, x, p), keep = 0.2 * volume(x, tet);
    REQUIRE(t > 0);
    for (int i = 1; i <= 300; ++i) REQUIRE(volume(x + t * i / 300.0 * p, tet) >= keep * (1 - 1e-6));
    if (t == 1) continue;
    ++cut;
    // just behind it the volume does fall below the bound
    REQUIRE(volume(x + (t + 1e-6) * p, tet) <= keep + 1e-3 * volume(x, tet));
  }
  CHECK(cut > 500);
}

TEST_CASE("inversion: the worst of many tets decides, in any order", "[filters]") {
  const TetBody box(Vec3(1, 1, 1), {7, 7, 7});  // several chunks of tets
  World world;
  RandomMotions random(6);
  const VecX p = 0.3 * random.vectors(box.rest.size());
  world.tets = box.body.tets;
  const double all = largest_step("inversion", world, box.rest, p);
  double smallest = 1;
  for (const Tet& tet : box.body.tets) {
    world.tets = {tet};
    smallest = std::min(smallest, largest_step("inversion", world, box.rest, p));
  }
  CHECK(all < 1);
  CHECK(all == Approx(smallest).epsilon(1e-6));
}

TEST_CASE("ccd finds the same step in stages as in one search", "[filters]") {
  Fall fall;
  for (const double speed : {0.01, 0.3, 3.0, 80.0}) {
    for (const Vec3& direction : {Vec3(0.3, -1, 0.1), Vec3(1, -0.02, 0), Vec3(0.2, 1, 0)}) {
      Fall whole;
      const VecX p = fall.motion(speed * direction);
      whole.world.contact->cover(whole.x, p);  // all candidates of the displacement
      const double expected = largest_step("ccd", whole.world, whole.x, p);
      INFO(speed << " " << direction.transpose());
      CHECK(largest_step("ccd", fall.world, fall.x, p) == expected);
    }
  }
}

TEST_CASE("ccd skips no pair that would have stopped the step", "[filters]") {
  TestScene scene(three_boxes(3) + "contact: {distance: 2 mm}\n");
  World& world = *scene.world;
  const CollisionMesh& mesh = world.contact->surface().mesh;
  RandomMotions random(31);
  int cut = 0;
  for (int trial = 0; trial < 40; ++trial) {
    const VecX x = world.rest + 1e-3 * random.vectors(world.rest.size());
    const VecX p = std::pow(10.0, random.uniform(-3.5, -1)) * random.vectors(x.size());
    const auto at = [&](int v) { return Vec3(vertex(x, v)); };
    const auto by = [&](int v) { return Vec3(vertex(p, v)); };
    double expected = 1;
    for (const int v : mesh.vertices)
      for (const auto& [a, b, c] : mesh.triangles)
        if (v != a && v != b && v != c)
          expected = point_triangle_accd(at(v), at(a), at(b), at(c), by(v), by(a), by(b), by(c), 0.1, expected);
    for (const auto& [a, b] : mesh.edges)
      for (const auto& [c, d] : mesh.edges)
        if (a != c && a != d && b != c && b != d)
          expected = edge_edge_accd(at(a), at(b), at(c), at(d), by(a), by(b), by(c), by(d), 0.1, expected);
    const double t = largest_step("ccd", world, x, p);
    CHECK(t == Approx(expected).epsilon(0.02));  // pairs that only just pass may be left to their bounds
    cut += t < 1;
  }
  CHECK(cut > 10);
  CHECK(cut < 30);
}

TEST_CASE("ccd does not search the whole path of a fast step", "[filters]") {
  // Twenty boxes in a row; the first flies at the second.
  std::string objects = "objects:\n";
  for (int i = 0; i < 20; ++i)
    objects += "  - {name: b" + std::to_string(i) + ", shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3]}, place: "
               "{translate: [" + std::to_string(0.15 * i) + ", 0, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n";
  TestScene scene(objects + "contact: {distance: 1 mm}\n");
  World& world = *scene.world;
  VecX p = VecX::Zero(world.rest.size());
  for (int v = 0; v < world.bodies[0].vertex_count; ++v) vertex(p, v) = Vec3(100, 0, 0);
  const double t = largest_step("ccd", world, world.rest, p);
  CHECK(100 * t == Approx(0.05 * 0.9).epsilon(0.03));
  const size_t in_stages = world.contact->candidates().size();
  world.contact->cover(world.rest, p);
  CHECK(world.contact->candidates().size() > 5 * in_stages);
}

TEST_CASE("filters report the primitives that bound a step", "[filters]") {
  Fall fall;
  const auto blocker = [&](const std::string& filter, const VecX& p) {
    PhaseClock clock;
    const auto f = Registry<StepFilter>::make(filter);
    clock.deadline().limit_run(Deadline::Clock::now(), 0);  // a diagnosis is made when time is out
    const FeasibilityContext context{fall.world.contact.get(), fall.world.tets, clock};
    REQUIRE(f->attach(context));
    return f->blocker(fall.x, p);
  };
  const VecX down = fall.motion({0, -30, 0});
  const auto pair = blocker("ccd", down);
  REQUIRE(pair);
  CHECK(pair->step == Approx(largest_step("ccd", fall.world, fall.x, down)).epsilon(1e-9));
  CHECK(30 * pair->step == Approx(0.9 * pair->gap).epsilon(0.03));
  CHECK(pair->first.size() == 1);  // a corner on the sheet
  CHECK(pair->second.size() == 3);
  CHECK_FALSE(blocker("ccd", fall.motion({0, 1, 0})));
  VecX crush = VecX::Zero(fall.x.size());
  const Tet& tet = fall.world.tets.back();
  vertex(crush, tet[0]) = 2 * (vertex(fall.x, tet[1]) - vertex(fall.x, tet[0]));
  const auto element = blocker("inversion", crush);
  REQUIRE(element);
  CHECK(element->first.size() == 4);
  CHECK(element->second.empty());
  CHECK(element->step == Approx(largest_step("inversion", fall.world, fall.x, crush)).epsilon(1e-9));
  CHECK_FALSE(blocker("inversion", fall.motion({1, 2, 3})));
}

TEST_CASE("ccd stops at the time limit", "[filters]") {
  Fall fall;
  PhaseClock clock;
  clock.deadline().limit_run(Deadline::Clock::now(), 0);
  const auto f = Registry<StepFilter>::make("ccd");
  const FeasibilityContext context{fall.world.contact.get(), fall.world.tets, clock};
  REQUIRE(f->attach(context));
  const int builds = fall.world.contact->broad_phase_builds();
  CHECK(f->largest_step(fall.x, fall.motion({0, 1000, 0}), 1) == 0);  // free, but not examined
  CHECK(fall.world.contact->broad_phase_builds() <= builds + 1);      // one stage of many
}

TEST_CASE("filters without objects do not attach", "[filters]") {
  PhaseClock clock;
  const std::vector<Tet> none;
  for (const std::string& name : Registry<StepFilter>::kind().names())
    CHECK_FALSE(Registry<StepFilter>::make(name)->attach({nullptr, none, clock}));
}
