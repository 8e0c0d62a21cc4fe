// Rods and particles that roll by friction: derivatives, closed forms on a slope and on the flat,
// momentum.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "framework/contact/terms/friction_term.hpp"
#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

constexpr double R = 5e-3, g = 9.81;  // m, m/s^2

std::string rod(const std::string& more, const std::string& name = "rod", const std::string& place = "angle: 90 deg, translate: [0, 5.983 mm, 0]") {
  return fmt::format("  - {{name: {}, shape: {{type: segment, length: 0.1, edges: 5}}, rod: {{radius: 5 mm}}, contact_offset: 5 mm, place: {{{}}}, "
                     "energies: [{{type: elastic_rod, young: 10 MPa, density: 1100, rolling: true}}]{}}}\n", name, place, more);
}

std::string ball(const std::string& more, const std::string& name = "ball", const std::string& at = "[0, 5.983 mm, 0.2]") {
  return fmt::format("  - {{name: {}, shape: {{type: points}}, particle: {{radius: 5 mm}}, contact_offset: 5 mm, place: {{translate: {}}}, "
                     "energies: [{{type: particle, density: 1100, rolling: true}}]{}}}\n", name, at, more);
}

// A floor along (x, z); gravity as on a slope that falls towards x by the angle.
std::string on_floor(const std::string& objects, double angle, double mu, const std::string& integrator = "bdf2") {
  return fmt::format("time: {{step: 5 ms, duration: 1, integrator: {}}}\ngravity: [{}, {}, 0]\nobjects:\n"
                     "  - {{name: floor, shape: {{type: box, size: [2, 0.1, 2]}}, place: {{translate: [0, -0.05, 0]}}, motion: [fixed]}}\n{}"
                     "contact: {{distance: 1 mm, friction: {{mu: {}, eps_v: 0.1 mm/s}}}}\n",
                     integrator, g * std::sin(angle), -g * std::cos(angle), objects, mu);
}

double way(const TestRun& run, int body) { return (run.world->centre_of_mass(body, run.state().x) - run.world->centre_of_mass(body, run.world->start.x)).x(); }
Vec3 speed(const TestRun& run, int body) { return run.world->centre_of_mass(body, run.state().v) ; }

// Returns the angular velocity [rad/s] of a body with one particle, or that of the first edge of a rod about its tangent.
Vec3 angular_velocity(const TestRun& run, int body) {
  const Body& b = run.world->bodies[body];
  const auto& extra = b.extra_vertices;
  const auto arc = [&](int i) { return run.state().v(3 * extra[i]); };
  if (b.rod) return arc(0) / (R / std::sqrt(2)) * (run.at(b.edges[0][1]) - run.at(b.edges[0][0])).normalized();
  return Vec3(arc(0), arc(1), arc(2)) / (std::sqrt(0.4) * R);
}

// Returns the angle [rad] by which the particle or the first edge of the rod has turned since the start.
double angle_about_z(const TestRun& run, int body) {
  const Body& b = run.world->bodies[body];
  const auto arc = [&](int i) { return run.state().x(3 * b.extra_vertices[i]); };
  return b.rod ? arc(0) / (R / std::sqrt(2)) * (run.at(b.edges[0][1]) - run.at(b.edges[0][0])).normalized().z() : arc(2) / (std::sqrt(0.4) * R);
}

void run_until(TestRun& run, double time) {
  while (run.state().time < time - 1e-9) run.step();
}

}  // namespace

TEST_CASE("rolling friction: derivatives are those of the value, and projections are semi-definite", "[rolling]") {
  const std::string crossed = "angle: 90 deg, axis: [0, 1, 0], translate: [0, 5.983 mm, 0]";
  const std::string scenes[] = {on_floor(rod("", "rod", crossed) + ball(""), 0.1, 0.5),
                                on_floor(ball("", "one", "[0, 5.983 mm, 0]") + ball("", "two", "[4 mm, 15 mm, 3 mm]"), 0, 0.5),
                                on_floor(rod("", "rod", crossed) + rod("", "other", "angle: 20 deg, axis: [0, 1, 0], translate: [3 mm, 16.5 mm, 4 mm]") +
                                             ball("", "ball", "[3 mm, 16 mm, 33 mm]"), 0, 0.5)};
  for (const std::string& yaml : scenes) {
    TestScene s(yaml);
    World& world = *s.world;
    VecX x = world.start.x;
    world.participants.load_history({});
    world.participants.begin_step({x, 0, 5e-3});
    const FrictionTerm& term = *world.friction;
    int turning = 0;
    for (const StencilBatch& b : term.batches()) turning += b.scalars > 0 ? b.count : 0;
    REQUIRE(turning > 0);
    RandomMotions random(3);
    for (const double size : {1e-7, 1e-4}) {  // it sticks, it slides
      VecX y = world.start.x;
      for (int i = 0; i < y.size(); ++i)
        if (i / 3 < world.mesh_vertex_count() || i % 3 == 0) y(i) += size * random.uniform(-1, 1);
      const VecX gradient = dense_gradient(term, y);
      const MatX exact = dense_hessian(term, y, Projection::none);
      const auto value = [&](const VecX& z) { return term.value(z); };
      const auto slope = [&](const VecX& z) { return dense_gradient(term, z); };
      VecX by_value = gradient_by_differences(value, y, 1e-2 * size);
      MatX by_slope = hessian_by_differences(slope, y, 1e-2 * size);
      CHECK((gradient - by_value).norm() < 1e-4 * gradient.norm());
      CHECK((exact - by_slope).norm() < 1e-3 * exact.norm());
      CHECK((term.forces(y, TangentialTerm::all) + gradient).norm() < 1e-12 * gradient.norm());
      CHECK(smallest_eigenvalue(dense_hessian(term, y, Projection::clamp)) >= -1e-9 * exact.norm());
    }
  }
}

TEST_CASE("rolling friction: a rod and a ball roll down a slope, or slide and turn beyond the limit", "[rolling]") {
  const double angle = 10 * std::numbers::pi / 180, t = 0.5;
  struct Case {
    double mu;
    const char* integrator;
  };
  // tan(a) is 0.1763: the rod slides below mu = 0.0588, the ball below 0.0504.
  for (const Case& c : {Case{0.5, "bdf2"}, Case{0.5, "implicit_euler"}, Case{0.5, "newmark"}, Case{0.055, "bdf2"}, Case{0.03, "bdf2"}}) {
    INFO(c.mu << " " << c.integrator);
    TestRun run(on_floor(rod("") + ball(""), angle, c.mu, c.integrator));
    CHECK(run.warnings.empty());
    run_until(run, t);
    for (const int body : {1, 2}) {
      INFO(body);
      const double k = body == 1 ? 0.5 : 0.4;  // I / (m R^2)
      const bool slides = std::tan(angle) > c.mu * (1 + 1 / k);
      const double a = slides ? g * (std::sin(angle) - c.mu * std::cos(angle)) : g * std::sin(angle) / (1 + k);
      const double turning = slides ? c.mu * g * std::cos(angle) / (k * R) : a / R;
      CHECK(way(run, body) == Approx(a * t * t / 2).epsilon(0.012));
      CHECK(-angle_about_z(run, body) == Approx(turning * t * t / 2).epsilon(0.012));
      // Newmark does not damp what friction sets ringing from one step to the next.
      if (c.integrator != std::string("newmark")) CHECK(-angular_velocity(run, body).z() == Approx(turning * t).epsilon(0.012));
      CHECK(angular_velocity(run, body).cross(Vec3::UnitZ()).norm() < 1e-3 * turning * t);
    }
  }
}

TEST_CASE("rolling friction: a rod and a ball thrown along the floor roll in the end, with 2/3 and 5/7 of their speed", "[rolling]") {
  TestRun run(on_floor(rod(", velocity: [0.3, 0, 0]") + ball(", velocity: [0.3, 0, 0]") + ball(", velocity: [0.3, 0, 0], spin: [0, 0, 60]", "back", "[0, 5.983 mm, 0.3]"), 0, 0.3));
  run_until(run, 0.3);
  CHECK(speed(run, 1).x() == Approx(0.2).epsilon(0.01));
  CHECK(speed(run, 2).x() == Approx(0.3 * 5 / 7).epsilon(0.01));
  CHECK(speed(run, 3).x() == Approx(0.3 * 5 / 7 - 60 * R * 2 / 7).epsilon(0.02));  // backspin
  for (const int body : {1, 2, 3}) CHECK(-angular_velocity(run, body).z() * R == Approx(speed(run, body).x()).epsilon(0.01));
}

// Friction acts at the contact offset and not across the gap, so angular momentum is off by the gap over both radii, up to 1 / 200, of what friction exchanges.
TEST_CASE("rolling friction: balls that collide off their centres keep momentum and angular momentum", "[rolling]") {
  TestRun run("time: {step: 0.02 ms, duration: 1, integrator: bdf2}\nobjects:\n" + ball(", velocity: [0.5, 0, 0], spin: [0, 0, 300]", "one", "[-6 mm, 0, 0]") +
              ball(", spin: [0, 50, 100]", "two", "[6 mm, 5 mm, 2 mm]") + "contact: {distance: 0.05 mm, friction: {mu: 0.4}}\n");
  const double m = run.world->mass(0), inertia = 0.4 * m * R * R;
  const auto momentum = [&] { return Vec3(m * (speed(run, 0) + speed(run, 1))); };
  const auto orbital = [&] { return Vec3(m * (run.at(0).cross(speed(run, 0)) + run.at(1).cross(speed(run, 1)))); };
  const auto spin = [&](int body) { return Vec3(inertia * angular_velocity(run, body)); };
  const Vec3 p = momentum(), orbit = orbital(), first = spin(0), second = spin(1), whole = orbit + first + second;
  run_until(run, 0.012);
  const double exchanged = (spin(0) - first).norm() + (spin(1) - second).norm();
  CHECK(exchanged > 0.1 * first.norm());
  CHECK((momentum() - p).norm() < 1e-6 * p.norm());
  CHECK((orbital() + spin(0) + spin(1) - whole).norm() < 0.01 * exchanged);
}

TEST_CASE("rolling friction: fixed objects do not turn, and objects that cannot roll are refused", "[rolling]") {
  TestRun run(on_floor(ball(", motion: [fixed]", "still", "[0, 5.983 mm, 0]") + ball(", velocity: [0.1, 0, 0]", "ball", "[0, 16.5 mm, 0]"), 0, 0.3));
  run_until(run, 0.05);
  CHECK(angular_velocity(run, 1).norm() == 0);
  CHECK(angular_velocity(run, 2).norm() > 1);
  const auto refused = [](const std::string& object) -> std::string {
    try {
      TestScene s(on_floor(object, 0, 0.3));
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  CHECK_THAT(refused("  - {name: it, shape: {type: points}, particle: {radius: 5 mm}, place: {translate: [0, 1, 0]}, energies: [{type: particle, rolling: true}]}\n"),
             Catch::Contains("contact_offset"));
  CHECK_THAT(refused("  - {name: it, shape: {type: segment, length: 1}, rod: {width: 5 mm, height: 2 mm, normal: [0, 1, 0]}, contact_offset: 1 mm, place: {translate: [0, 1, 0]}, "
                     "energies: [{type: elastic_rod, young: 1 MPa, rolling: true}]}\n"),
             Catch::Contains("do not roll"));
}
