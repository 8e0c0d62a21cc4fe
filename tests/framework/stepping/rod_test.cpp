// Motion of rods and particles against beam theory.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <numbers>

#include "framework/rod/rod_frames.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/program.hpp"
#include "tests/support/rms_difference.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;
using Catch::Contains;
using std::numbers::pi;

namespace {

std::string vertices(const std::string& list) { return "select: {type: indices, vertices: [" + list + "]}"; }

// A line of edges as a mesh file, with vertices at these coordinates.
std::string line_file(const TemporaryFolder& folder, const std::vector<Vec3>& points, bool closed = false) {
  std::string text;
  for (const Vec3& p : points) text += fmt::format("v {:.17g} {:.17g} {:.17g}\n", p.x(), p.y(), p.z());
  for (size_t i = 1; i < points.size(); ++i) text += fmt::format("l {} {}\n", i, i + 1);
  if (closed) text += fmt::format("l {} 1\n", points.size());
  const auto path = folder.path() / "line.obj";
  write_file(path, text);
  return "{type: file, path: " + path.string() + "}";
}

// Returns vertex coordinates: of equal edges, or of lengths that differ by a factor of three.
std::vector<double> stations(int edges, bool even) {
  std::vector<double> s = {0};
  for (int e = 0; e < edges; ++e) s.push_back(s.back() + (even || e == 0 ? 1 : e % 2 ? 0.5 : 1.5));
  for (double& x : s) x /= s.back();
  return s;
}

// A rod of 1 m along x, fixed at its first edge; by default of 1 GPa, 10 x 20 mm^2 and 1000 kg/m^3.
std::string cantilever(const std::string& shape, const std::string& more, const std::string& time,
                       const std::string& section = "width: 10 mm, height: 20 mm, normal: [0, 1, 0]") {
  return fmt::format("time: {{{}}}\nsolver: {{type: projected_newton, tolerance: 1e-7, linear: cholmod}}\nobjects:\n"
                     "  - name: rod\n    shape: {}\n    rod: {{{}}}\n"
                     "    energies: [{{type: elastic_rod, young: 1 GPa, poisson: 0.25, density: 1000}}]\n"
                     "    motion: [{{type: fixed, {}}}]\n{}", time, shape, section, vertices("0, 1"), more);
}

// The tip of an inextensible cantilever of length 1 under a force f across its start, with bending stiffness 1: the curve
// theta'' = -f cos(theta), theta(0) = 0, theta'(1) = 0 (Euler's elastica), by shooting with Runge and Kutta's method.
Vec2 elastica(double f) {
  const auto shoot = [&](double slope, Vec2& tip) {
    constexpr int n = 2000;
    const double h = 1.0 / n;
    Eigen::Vector4d y(0, slope, 0, 0);  // theta, theta', x, y
    const auto rate = [&](const Eigen::Vector4d& s) {
      return Eigen::Vector4d(s(1), -f * std::cos(s(0)), std::cos(s(0)), std::sin(s(0)));
    };
    for (int i = 0; i < n; ++i) {
      const Eigen::Vector4d a = rate(y), b = rate(y + h / 2 * a), c = rate(y + h / 2 * b), d = rate(y + h * c);
      y += h / 6 * (a + 2 * b + 2 * c + d);
    }
    tip = y.tail<2>();
    return y(1);
  };
  double low = 0, high = f;
  Vec2 tip;
  for (int i = 0; i < 60; ++i) (shoot((low + high) / 2, tip) > 0 ? high : low) = (low + high) / 2;
  return tip;
}

// Returns the time of the k-th change of sign of the first value of a probe [s].
double crossing(TestRun& run, int k, const std::function<double()>& value) {
  double before = value();
  for (;;) {
    const double t = run.state().time;
    run.step();
    const double now = value();
    if (before * now < 0 && --k == 0) return t + (run.state().time - t) * before / (before - now);
    before = now;
    REQUIRE(run.state().time < 10);
  }
}

}  // namespace

TEST_CASE("a cantilever bends by beam theory, about both axes of its section", "[rod]") {
  const bool even = GENERATE(true, false), upright = GENERATE(true, false);
  const int edges = GENERATE(16, 40);
  CAPTURE(even, upright, edges);
  const TemporaryFolder folder;
  std::vector<Vec3> points;
  const std::vector<double> s = stations(edges, even);
  for (const double x : s) points.emplace_back(x, 0, 0);
  TestRun run(cantilever(line_file(folder, points),
                         fmt::format("    loads: [{{type: force, value: {}, {}}}]\n", upright ? "[0, -0.2, 0]" : "[0, 0, -0.05]",
                                     vertices(std::to_string(edges))),
                         "step: 1 s, duration: 1 s, integrator: quasi_static"));
  run.step();
  const double length = 1 - s[1] / 2;  // from the middle of the edge that is fixed
  const double stiffness = 1e9 * (upright ? 0.01 * std::pow(0.02, 3) : 0.02 * std::pow(0.01, 3)) / 12;
  const double sag = -(upright ? run.at(edges).y() : run.at(edges).z());
  CHECK(sag == Approx((upright ? 0.2 : 0.05) * std::pow(length, 3) / (3 * stiffness)).epsilon(0.02));
}

TEST_CASE("a cantilever under a large force is an elastica", "[rod]") {
  const int edges = GENERATE(20, 50);
  const double force = GENERATE(2.0, 8.0);
  CAPTURE(edges, force);
  const double fixed_edge = 1.0 / edges, length = 1 - fixed_edge / 2, stiffness = 1e9 * pi * std::pow(0.005, 4) / 4;
  TestRun run(cantilever(fmt::format("{{type: segment, length: 1, edges: {}}}", edges),
                         fmt::format("    loads: [{{type: force, value: [0, {}, 0], {}, ramp: [[0, 0], [1, 1]]}}]\n", force * stiffness / (length * length),
                                     vertices(std::to_string(edges))),
                         "step: 0.25 s, duration: 1 s, integrator: quasi_static", "radius: 5 mm"));
  for (int i = 0; i < 4; ++i) run.step();
  const Vec2 tip = elastica(force), start(-0.5 + fixed_edge / 2, 0);
  const Vec2 off = (run.at(edges).head<2>() - start) / length - tip;
  CHECK(off.norm() < 0.02 * (tip - Vec2(1, 0)).norm());
  CHECK(run.at(edges).y() / length == Approx(tip.y()).epsilon(0.02));
}

TEST_CASE("a rod twisted by a prescribed motion has the torque G J theta / L, also after several turns", "[rod]") {
  const std::string section = GENERATE("radius: 10 mm", "width: 30 mm, height: 10 mm, normal: [0, 1, 1]");
  const bool circular = section.starts_with("radius");
  CAPTURE(section);
  const int edges = 20;
  // It is soft in shear, so that it does not buckle. Its end is on a slide, so that the rotated edge is twisted by its motion alone.
  TestRun run(fmt::format("time: {{step: 0.1 s, duration: 1 s, integrator: quasi_static}}\n"
                          "solver: {{type: projected_newton, tolerance: 1e-7, linear: cholmod}}\nobjects:\n"
                          "  - name: rod\n    shape: {{type: segment, length: 1, edges: {}}}\n    rod: {{{}}}\n"
                          "    energies: [{{type: elastic_rod, young: 1 GPa, shear: 1 MPa, density: 1000}}]\n"
                          "    motion: [{{type: fixed, {}}}, {{type: rotate, axis: [1, 0, 0], angular_velocity: 25 rad/s, {}}}]\n"
                          "probes: [{{name: moment, type: torque, object: rod, direction: [1, 0, 0], {}}}]\n",
                          edges, section, vertices("0, 1"), vertices(fmt::format("{}, {}", edges - 1, edges)),
                          vertices(fmt::format("{}, {}", edges - 1, edges))));
  const double stiffness = 1e6 * (circular ? pi * std::pow(0.01, 4) / 2 : 0.2632 * 0.03 * std::pow(0.01, 3));
  for (int i = 1; i <= 10; ++i) {
    run.step();
    CHECK(run.sample(0)[0] == Approx(stiffness * 2.5 * i / (1 - 1.0 / edges)).epsilon(0.02));
  }
  const auto& rod = *run.world->bodies[0].rod;
  CHECK(rod.angle(edges - 1, run.state().x) == Approx(25).epsilon(1e-9));
  CHECK(rod.angle(edges / 2, run.state().x) == Approx(25.0 * (edges / 2) / (edges - 1)).epsilon(0.01));
}

TEST_CASE("a prescribed motion that rotates an end in space, and one that releases it", "[rod]") {
  // The last edge rotates about z, across itself, and about itself in between; the frame of the edge follows the rotation of space.
  TestRun run("time: {step: 20 ms, duration: 2 s}\nobjects:\n"
              "  - name: rod\n    shape: {type: segment, length: 1, edges: 10}\n    rod: {width: 30 mm, height: 10 mm, normal: [0, 1, 0]}\n"
              "    energies: [{type: elastic_rod, young: 1 MPa, density: 1000}]\n"
              "    motion: [{type: keyframes, until: 1 s, centre: [-0.5, 0, 0], " + vertices("0, 1") +
              ", frames: [{time: 0 s}, {time: 0.5 s, rotation: [0, 0, 1.2]}, {time: 1 s, rotation: [1.5, 0.5, 1.2]}]}]\n");
  const auto& rod = *run.world->bodies[0].rod;
  while (run.state().time < 0.99) run.step();
  const Vec3 w(1.5, 0.5, 1.2);
  const Mat3 r = Eigen::AngleAxisd(w.norm(), w.normalized()).toRotationMatrix();
  CHECK((rod.director(0, run.state().x) - r * Vec3::UnitY()).norm() < 1e-9);
  CHECK((rod.tangent(0, run.state().x) - r * Vec3::UnitX()).norm() < 1e-9);
  const double speed = run.state().v(3 * rod.twists()[0]);
  CHECK(speed != 0);
  run.step();
  CHECK(run.world->dofs.moves(rod.twists()[0]));
  CHECK(run.state().v(3 * rod.twists()[0]) != 0);
}

// Zajac 1962, Stability of two planar loop elasticas; Michell 1889: a straight rod that was closed to a ring after
// its ends were turned against each other by more than 2 pi sqrt(3) E I / (G J) does not stay plane.
TEST_CASE("a twisted ring leaves its plane at Michell's twist", "[rod]") {
  const double above = GENERATE(0.92, 1.08);
  const int edges = 48;
  const TemporaryFolder folder;
  std::vector<Vec3> points;
  for (int i = 0; i < edges; ++i) {
    const double a = 2 * pi * i / edges;
    points.emplace_back(std::cos(a), std::sin(a), 1e-3 * std::cos(2 * a));
  }
  const double shear = 0.4e9, ratio = 1e9 / 4 * pi / (shear * pi / 2);  // E I / G J
  TestRun run(fmt::format("time: {{step: 20 ms, duration: 100 s}}\nsolver: {{type: projected_newton, tolerance: 1e-7, linear: cholmod}}\nobjects:\n"
                          "  - name: ring\n    shape: {}\n    rod: {{radius: 20 mm}}\n    damping: {{mass: 4}}\n"
                          "    energies: [{{type: elastic_rod, young: 1 GPa, shear: {}, density: 1000, rest: straight, twist: {}}}]\n",
                          line_file(folder, points, true), shear, above * 2 * pi * std::sqrt(3.0) * ratio / (2 * pi)));
  const auto height = [&] {
    double sum = 0;
    for (int i = 0; i < edges; ++i) sum += 2.0 / edges * run.at(i).z() * std::cos(4 * pi * i / edges);
    double other = 0;
    for (int i = 0; i < edges; ++i) other += 2.0 / edges * run.at(i).z() * std::sin(4 * pi * i / edges);
    return std::hypot(sum, other);
  };
  const double start = height();
  double largest = 0;
  for (int i = 0; i < 100; ++i) {
    run.step();
    largest = std::max(largest, height());
  }
  CAPTURE(start, largest, height());
  CHECK((largest > 0.1) == (above > 1));
  CHECK((height() < 0.1 * start) == (above < 1));
}

TEST_CASE("a cantilever swings at the frequency of beam theory", "[rod]") {
  const int edges = 30;
  TestRun run(cantilever(fmt::format("{{type: segment, length: 1, edges: {}}}", edges), "    velocity: [0, 0, 0]\n    loads: [{type: force, value: [0, 0.1, 0], " +
                             vertices(std::to_string(edges)) + ", ramp: [[0 s, 0], [0.3 s, 1], [0.30001 s, 0]]}]\n",
                         "step: 2 ms, duration: 5 s, integrator: newmark"));
  while (run.state().time < 0.32) run.step();
  const auto tip = [&] { return run.at(edges).y(); };
  const double first = crossing(run, 1, tip), fourth = crossing(run, 6, tip);
  const double length = 1 - 0.5 / edges;
  const double omega = 1.87510407 * 1.87510407 / (length * length) * std::sqrt(1e9 * 0.01 * std::pow(0.02, 3) / 12 / (1000 * 0.0002));
  CHECK(2 * pi * 3 / (fourth - first) == Approx(omega).epsilon(0.02));
}

TEST_CASE("a shaft fixed at one end swings about its axis at a quarter of the shear wave length", "[rod]") {
  const int edges = 30;
  TestRun run(cantilever(fmt::format("{{type: segment, length: 1, edges: {}}}", edges), "    spin: [5, 0, 0]\n",
                         "step: 0.05 ms, duration: 5 s, integrator: newmark", "radius: 10 mm"));
  const auto& rod = *run.world->bodies[0].rod;
  CHECK(run.state().v(3 * rod.twists()[edges - 1]) == Approx(5 * 0.01 / std::sqrt(2.0)));
  const auto tip = [&] { return rod.angle(edges - 1, run.state().x); };
  const double first = crossing(run, 1, tip), later = crossing(run, 4, tip);
  const double speed = std::sqrt(1e9 / 2.5 / 1000), length = 1 - 0.5 / edges;  // of shear waves
  CHECK(2 * pi * 2 / (later - first) == Approx(pi / 2 * speed / length).epsilon(0.02));
}

TEST_CASE("a rod that spins freely about its axis, or across it, keeps its energy and momentum", "[rod]") {
  const std::string spin = GENERATE("[20, 0, 0]", "[0, 6, 0]");
  TestRun run(fmt::format("time: {{step: 1 ms, duration: 1 s, integrator: newmark}}\nobjects:\n"
                          "  - name: rod\n    shape: {{type: segment, length: 1, edges: 8}}\n    rod: {{radius: 20 mm}}\n    spin: {}\n"
                          "    energies: [{{type: elastic_rod, young: 100 MPa, density: 1000}}]\n"
                          "probes: [{{name: kinetic, type: energy, term: kinetic}}, {{name: mass, type: centre_of_mass, object: rod}}]\n", spin));
  const double mass = 1000 * pi * 4e-4, before = run.sample(0)[0];
  double sum = 0;
  for (int v = 0; v < 9; ++v) sum += run.world->mass(v);
  CHECK(sum == Approx(mass));
  if (spin[1] == '2') CHECK(before == Approx(mass * 2e-4 / 2 * 400));  // half of rho J_p L w^2
  for (int i = 0; i < 400; ++i) run.step();
  CHECK(run.sample(0)[0] == Approx(before).epsilon(0.01));
  CHECK(Vec3(run.sample(1)[0], run.sample(1)[1], run.sample(1)[2]).norm() < 1e-8);
  if (spin[1] == '2') CHECK(run.world->bodies[0].rod->angle(3, run.state().x) == Approx(20 * 0.4).epsilon(1e-6));
}

TEST_CASE("a helix at rest stays, and a straight mesh with that curvature and twist becomes one", "[rod]") {
  TestRun run("time: {step: 0.05, duration: 1}\nsolver: {type: projected_newton, tolerance: 1e-6, linear: cholmod}\nobjects:\n"
              "  - name: rod\n    shape: {type: helix, radius: 0.1, pitch: 0.1, turns: 2, edges: 40}\n    rod: {radius: 5 mm}\n"
              "    energies: [{type: elastic_rod, young: 10 MPa, density: 1000}]\n    motion: [{type: fixed, " + vertices("0, 1") + "}]\n");
  for (int i = 0; i < 5; ++i) run.step();
  CHECK(rms_difference(run.state().x, run.world->rest) < 1e-10);

  // Curvature and torsion of a helix: a / (a^2 + b^2), b / (a^2 + b^2).
  const double a = 0.1, b = 0.1 / (2 * pi), s2 = a * a + b * b, length = 2 * pi * std::sqrt(s2);
  const std::string yaml = fmt::format("time: {{step: 0.05 s, duration: 50 s}}\nsolver: {{type: projected_newton, tolerance: 1e-7, linear: cholmod}}\nobjects:\n"
                                       "  - name: rod\n    shape: {{type: segment, length: {}, edges: 60}}\n    rod: {{radius: 5 mm}}\n    damping: {{mass: 5}}\n"
                                       "    energies: [{{type: elastic_rod, young: 10 MPa, density: 1000, curvature: [{}, 0], twist: {}}}]\n"
                                       "    motion: [{{type: fixed, {}}}]\n", length, a / s2, b / s2, vertices("0, 1"));
  TestRun curling(yaml);
  for (int i = 0; i < 400; ++i) curling.step();
  // One turn: the last edge is a pitch away from the first, and parallel to it.
  const Vec3 span = curling.at(60) - curling.at(0);
  CHECK(span.norm() == Approx(0.1).epsilon(0.03));
  const auto& rod = *curling.world->bodies[0].rod;
  CHECK(rod.tangent(59, curling.state().x).dot(rod.tangent(0, curling.state().x)) > 0.98);
  CHECK(curling.world->elastic_terms[0]->value(curling.state().x) < 1e-6 * 1e7 * pi / 4 * std::pow(5e-3, 4) / s2 * a * a / s2 * length);
}

TEST_CASE("a frame of welded rods keeps its corners", "[rod]") {
  const TemporaryFolder folder;
  // A mast with two arms at right angles, fixed at its foot. A force on an arm rotates the joint about the mast.
  std::string text;
  const int n = 10;
  std::vector<Vec3> points = {{0, 0, 0}};
  for (int i = 1; i <= n; ++i) points.emplace_back(0, 0.05 * i, 0);
  for (int i = 1; i <= n; ++i) points.emplace_back(0.05 * i, 0.5, 0);
  for (int i = 1; i <= n; ++i) points.emplace_back(0, 0.5, 0.05 * i);
  for (const Vec3& p : points) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
  for (int i = 0; i < n; ++i) text += fmt::format("l {} {}\n", i + 1, i + 2);
  text += fmt::format("l {} {}\nl {} {}\n", n + 1, n + 2, 2 * n + 2, n + 1);
  for (int i = 1; i < n; ++i) text += fmt::format("l {} {}\nl {} {}\n", n + 1 + i, n + 2 + i, 2 * n + 1 + i, 2 * n + 2 + i);
  write_file(folder.path() / "frame.obj", text);
  TestRun run(fmt::format("time: {{step: 1 s, duration: 1 s, integrator: quasi_static}}\nsolver: {{type: projected_newton, tolerance: 1e-8, linear: cholmod}}\nobjects:\n"
                          "  - name: frame\n    shape: {{type: file, path: {}}}\n    rod: {{radius: 10 mm}}\n"
                          "    energies: [{{type: elastic_rod, young: 1 GPa, poisson: 0.25, density: 1000}}]\n"
                          "    motion: [{{type: fixed, {}}}]\n    loads: [{{type: force, value: [0, 0, 0.1], {}}}]\n",
                          (folder.path() / "frame.obj").string(), vertices("0, 1"), vertices(std::to_string(2 * n))));
  run.step();
  const double bending = 1e9 * pi / 4 * 1e-8, twisting = 1e9 / 2.5 * pi / 2 * 1e-8, mast = 0.475, arm = 0.5, force = 0.1;
  // Tip of the arm: the mast bends and twists, the arm bends; the joint has the compliance of about half an edge.
  const double sway = force * std::pow(mast, 3) / (3 * bending), twist = force * arm * mast / twisting, bend = force * std::pow(arm, 3) / (3 * bending);
  CHECK(run.at(2 * n).z() == Approx(sway + twist * arm + bend).epsilon(0.03));
  // The other arm rotates with the joint.
  CHECK((run.at(3 * n).x() - run.at(n).x()) / arm == Approx(-twist).epsilon(0.03));
}

TEST_CASE("a particle flies freely, and a string hangs", "[rod][particle]") {
  TestRun run("time: {step: 10 ms, duration: 1, integrator: newmark}\ngravity: [0, -10, 0]\nobjects:\n"
              "  - {name: dust, shape: {type: points, size: [1, 0, 0], counts: [3, 1, 1]}, particle: {radius: 1 cm},\n"
              "     energies: [{type: particle, density: 2000}], velocity: [1, 2, 0]}\n"
              "  - {name: shot, shape: {type: points}, particle: {radius: 1 cm}, energies: [{type: particle, mass: 3 kg}]}\n");
  CHECK(run.world->mass(0) == Approx(2000 * 4.0 / 3 * pi * 1e-6));
  CHECK(run.world->mass(3) == 3);
  for (int i = 0; i < 50; ++i) run.step();
  CHECK((run.at(1) - Vec3(0.5, 2 * 0.5 - 10 * 0.125, 0)).norm() < 1e-9);
  CHECK((run.at(3) - Vec3(0, -1.25, 0)).norm() < 1e-9);

  TestRun string("time: {step: 1 s, duration: 1 s, integrator: quasi_static}\ngravity: [-10, 0, 0]\nobjects:\n"
                 "  - name: string\n    shape: {type: segment, length: 1, edges: 10}\n    rod: {radius: 1 mm}\n"
                 "    energies: [{type: string, young: 1 MPa, density: 1000}]\n    motion: [{type: fixed, " + vertices("10") + "}]\n");
  string.step();
  CHECK(-0.5 - string.at(0).x() == Approx(1000 * 10 * 1.0 / (2 * 1e6)).epsilon(1e-3));
  CHECK(string.world->dofs.size() == 30);  // no twists
}

TEST_CASE("a rod that continues as a string has twists in the rod only", "[rod]") {
  TestRun run("time: {step: 10 ms, duration: 1}\ngravity: [0, -10, 0]\nobjects:\n"
              "  - name: it\n    shape: {type: segment, length: 1, edges: 10}\n    rod: {width: 10 mm, height: 20 mm, normal: [0, 1, 0]}\n"
              "    selections: [{name: left, select: {type: box, min: [-1, -1, -1], max: [0.001, 1, 1]}}]\n"
              "    energies:\n      - {type: string, young: 10 MPa, density: 1000, select: {type: box, min: [-0.001, -1, -1], max: [1, 1, 1]}}\n"
              "      - {type: elastic_rod, young: 1 GPa, density: 1000, select: {type: tag, name: left}}\n"
              "    motion: [{type: fixed, " + vertices("0, 1") + "}]\n");
  const auto& rod = *run.world->bodies[0].rod;
  CHECK(rod.count() == 5);
  CHECK(run.world->mass.tail(5).minCoeff() > 0);
  CHECK(run.world->mass.head(11).sum() == Approx(1000 * 2e-4));
  for (int i = 0; i < 30; ++i) run.step();
  // Half of it stands out, the other half hangs.
  CHECK(run.at(5).y() > -0.1);
  CHECK(run.at(10).y() < -0.3);
}

TEST_CASE("the twist of a rod does not contribute to the force on it", "[rod]") {
  TestRun run("time: {step: 1 ms, duration: 1}\nobjects:\n"
              "  - {name: rod, shape: {type: segment, length: 0.1, edges: 4}, rod: {radius: 5 mm}, energies: [{type: elastic_rod, young: 1e6, density: 1000}], "
              "damping: {mass: 10}, spin: [20, 0, 0]}\n"
              "probes: [{name: resistance, type: force, of: damping, on: rod}]\n");
  run.step();
  CHECK(run.state().v(3 * run.world->bodies[0].rod->twists()[0]) > 0.01);
  for (const double f : run.sample(0)) CHECK(std::abs(f) < 1e-9);
}

TEST_CASE("a spring, an attachment and damping act on rods and particles", "[rod][particle]") {
  TestRun run("time: {step: 5 ms, duration: 1}\ngravity: [0, -10, 0]\nobjects:\n"
              "  - {name: rod, shape: {type: segment, length: 1, edges: 10}, rod: {radius: 10 mm}, damping: {stiffness: 10 ms, mass: 1},\n"
              "     energies: [{type: elastic_rod, young: 100 MPa, density: 1000}], motion: [{type: fixed, " + vertices("0, 1") + "}]}\n"
              "  - {name: bob, shape: {type: points}, place: {translate: [0.5, -0.2, 0]}, particle: {radius: 1 cm}, damping: {mass: 1},\n"
              "     energies: [{type: particle, mass: 20 g}]}\n"
              "  - {name: box, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.06, 0]}, body: affine,\n"
              "     motion: [fixed]}\n"
              "interactions: [{type: spring, name: thread, from: {object: bob}, to: {object: rod, " + vertices("10") + "}, stiffness: 10 N/m}]\n"
              "probes: [{name: lost, type: energy, term: dissipated_damping}]\n");
  for (int i = 0; i < 200; ++i) run.step();
  CHECK(run.sample(0)[0] > 0);
  CHECK((run.at(10) - run.at(11)).norm() == Approx(0.2 + 0.2 / 10).epsilon(0.05));
  CHECK(run.warnings == std::vector<Warning>{});
}

TEST_CASE("missing settings of rods and particles are reported with their location", "[rod][particle]") {
  const auto object = [](const std::string& keys) { return "time: {step: 1 ms, duration: 1}\nobjects:\n  - {name: it, " + keys + "}\n"; };
  const std::string line = "shape: {type: segment, length: 1, edges: 2}, ", box = "shape: {type: box, size: [1, 1, 1]}, ";
  const std::string rod = "energies: [{type: elastic_rod, young: 1e6}]";
  CHECK_THROWS_WITH(TestScene(object(line + rod)), Contains("test.yaml:4") && Contains("needs the section") && Contains("rod: {radius"));
  CHECK_THROWS_WITH(TestScene(object(line + "energies: [{type: string, young: 1e6}]")), Contains("needs the section"));
  CHECK_THROWS_WITH(TestScene(object(box + "rod: {radius: 1}, " + rod)), Contains("no explicit edges"));
  CHECK_THROWS_WITH(TestScene(object(box + rod)), Contains("needs explicit edges"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {radius: 1 mm, width: 1 mm}, " + rod)), Contains("give either radius, or width, height and normal"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {width: 1 mm, height: 1 mm}, " + rod)), Contains("give either radius"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {}, " + rod)), Contains("give either radius"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {radius: 0}, " + rod)), Contains("positive"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {width: 1 mm, height: 1 mm, normal: [1, 0, 0]}, " + rod)), Contains("along rod.normal"));
  CHECK_THROWS_WITH(TestScene(object(line + "rod: {width: 1 mm, height: 1 mm, normal: [0, 0, 0]}, " + rod)), Contains("must not be zero"));
  for (const char* section : {"radius: 1e100", "radius: 1e-100", "width: 1e110, height: 1 mm, normal: [0, 0, 1]"})
    CHECK_THROWS_WITH(TestScene(object(line + "rod: {" + section + "}, " + rod)), Contains("fourth power"));
  const std::string points = "shape: {type: points}, ", particle = "energies: [particle]";
  CHECK_THROWS_WITH(TestScene(object(points + particle)), Contains("test.yaml:4") && Contains("needs the radius"));
  CHECK_THROWS_WITH(TestScene(object(line + "particle: {radius: 1}, " + particle)), Contains("no explicit points"));
  CHECK_THROWS_WITH(TestScene(object(line + particle)), Contains("needs explicit points"));
  CHECK_THROWS_WITH(TestScene(object(points + "particle: {radius: -1}, " + particle)), Contains("positive"));
}
