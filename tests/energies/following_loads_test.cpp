// Following loads: derivatives, closed forms, and the energy balance.
#include <catch2/catch.hpp>

#include <Eigen/Geometry>

#include "framework/body/cavity_surface.hpp"
#include "framework/checks/derivative_check.hpp"
#include "framework/load/volume_term.hpp"
#include "geometry/errors.hpp"
#include "geometry/mesh/surface.hpp"
#include "geometry/shapes/solids.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

std::string scaled(double unit, double number) { return fmt::format("{:.12g}", unit * number); }

// A closed sheet, an open one, a solid with a cavity, an affine body and a body fixed at a face, each under every load.
struct Case {
  const char* name;
  const char* object;
  const char* load;
};

const char* const balloon = "shape: {type: sphere, radius: 0.1, cells: 4, surface: true}, shell: {thickness: 1 mm}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]";
const char* const sheet = "shape: {type: grid, size: [0.2, 0.3], cells: [3, 4], jitter: 0.2}, shell: {thickness: 1 mm}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]";
const char* const block = "shape: {type: box, size: [0.1, 0.2, 0.1], cells: [2, 3, 2]}, energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.3, density: 1000}]";
const char* const held = "shape: {type: box, size: [0.1, 0.2, 0.1], cells: [2, 3, 2]}, energies: [{type: neo_hookean, young: 0.1 MPa, poisson: 0.3, density: 1000}], "
                         "motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}, {type: fixed, along: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}]";
const char* const stone = "shape: {type: box, size: [0.1, 0.2, 0.1], cells: [2, 2, 2]}, body: {type: affine, density: 1000}";

const Case cases[] = {
    {"pressure in a balloon", balloon, "{type: pressure, value: 3 kPa, ramp: [[0, 1], [1, 2]]}"},
    {"pressure on a sheet", sheet, "{type: pressure, value: 200, ramp_formula: 1 + t}"},
    {"pressure on a part of a sheet", sheet, "{type: pressure, value: -200, select: {type: box, min: [-0.08, -1, -1], max: [1, 1, 1]}}"},
    {"pressure on a block", block, "{type: pressure, value: 5 kPa}"},
    {"pressure on a held block", held, "{type: pressure, value: 5 kPa, select: {type: face, direction: [0, 1, 0]}}"},
    {"pressure on an affine body", stone, "{type: pressure, value: 5 kPa, select: {type: face, direction: [1, 0, 0]}}"},
    {"gas", balloon, "{type: chamber, content: {type: gas, pressure: 110 kPa}}"},
    {"adiabatic gas in a vacuum", balloon, "{type: chamber, content: {type: gas, pressure: 4 kPa, ambient: 0, gamma: 1.4, leak: 2}}"},
    {"liquid", balloon, "{type: chamber, content: {type: liquid, bulk_modulus: 1 MPa, volume: [[0, 1], [1, 2]]}}"},
    {"pressure in a chamber", balloon, "{type: chamber, content: {type: pressure, value: 3 kPa}}"},
    {"torque", block, "{type: torque, value: 0.5, axis: [1, 2, 0.5]}"},
    {"torque about a point", held, "{type: torque, value: -0.5, axis: [0, 1, 0], point: [0.1, 0, 0.05], select: {type: face, direction: [0, 1, 0]}}"},
    {"torque on an affine body", stone, "{type: torque, value: 0.5, axis: [0, 1, 1]}"},
    {"wind", sheet, "{type: wind, velocity: [1, 20, 3]}"},
    {"wind on a block", block, "{type: wind, velocity: [1, 20, 3]}"},
    {"wind on an affine body", stone, "{type: wind, velocity: [1, 20, 3], drag: 2}"},
    {"field", block, "{type: field, x: -k * x, y: g * sin(y / l) - c * vy, z: x * y * 30, parameters: {k: 400 1/s^2, g: 9.81 m/s^2, l: 3 cm, c: 5 1/s}}"},
    {"field per volume on an affine body", stone, "{type: field, per: volume, x: -1e6 * x, z: 1e5 * z}"},
    {"field per area", sheet, "{type: field, per: area, y: 50 - 100 * abs(vy) * vy - 1e3 * y}"},
};

std::string scene(const Case& c, const std::string& more = "", const std::string& time = "{step: 10 ms, duration: 1}") {
  return "time: " + time + "\nobjects:\n  - {name: it, " + std::string(c.object) + ", loads: [" + c.load + "]" + more + "}\n";
}

const FollowingLoad& load_of(const World& world) {
  REQUIRE(world.following_loads.size() == 1);
  return *world.following_loads.front();
}

MatX hessian_of(const Term& term, const VecX& x, Projection projection) {
  MatX sum = dense_hessian(term, x, projection);
  GlobalModes modes;
  if (const auto* source = dynamic_cast<const GlobalModeSource*>(&term)) source->add_global_modes(x, projection, modes);
  for (const GlobalMode& mode : modes) sum += mode.coefficient * mode.vector * mode.vector.transpose();
  return sum;
}

}  // namespace

TEST_CASE("following loads: gradient and Hessian are those of the value, and projections are semi-definite", "[loads]") {
  for (const Case& c : cases) {
    INFO(c.name);
    TestScene s(scene(c, ", velocity: [0.3, -0.5, 0.1], spin: [1, 2, 3]"));
    World& world = *s.world;
    const Term& term = load_of(world);
    RandomMotions random(3);
    VecX x = world.start.x;
    const EndVelocity velocity{200, x - 0.004 * world.start.v};
    world.participants.load_history({});
    world.participants.begin_step({x, 0.2, 0.01, &velocity, &world.start.v});
    x += 4e-3 * random.vectors(x.size());
    const VecX gradient = dense_gradient(term, x);
    const MatX exact = hessian_of(term, x, Projection::none);
    const auto value = [&](const VecX& y) { return term.value(y); };
    const auto slope = [&](const VecX& y) { return dense_gradient(term, y); };
    CHECK((gradient - gradient_by_differences(value, x, 1e-4)).norm() < 1e-7 * gradient.norm());
    CHECK((exact - hessian_by_differences(slope, x, 1e-4)).norm() < 1e-6 * exact.norm() + 1e-9 * gradient.norm() / 0.1);
    CHECK((exact - exact.transpose()).norm() < 1e-12 * exact.norm() + 1e-30);
    for (const Projection projection : {Projection::clamp, Projection::absolute, Projection::majorize}) {
      const MatX h = hessian_of(term, x, projection);
      CHECK(smallest_eigenvalue(h) >= -1e-10 * exact.norm());
      if (projection != Projection::absolute) CHECK(smallest_eigenvalue(h - exact) >= -1e-10 * exact.norm());
    }
  }
}

TEST_CASE("following loads: tack check finds nothing wrong", "[loads]") {
  for (const Case& c : cases) {
    INFO(c.name);
    TestScene s(scene(c));
    for (const DerivativeCheck& check : check_derivatives(*s.world, 0.01, s.clock)) CHECK_FALSE(check.wrong());
  }
}

// A closed surface has neither net force nor moment.
TEST_CASE("a pressure within a closed surface has no net force and no moment", "[loads]") {
  for (const int i : {0, 6, 8}) {
    TestScene s(scene(cases[i]));
    World& world = *s.world;
    world.participants.begin_step({world.start.x, 0.2, 0.01});
    RandomMotions random(5);
    const VecX x = world.start.x + 5e-3 * random.vectors(world.start.x.size()), g = dense_gradient(load_of(world), x);
    CHECK(g.norm() > 0.1);
    CHECK(total(g).norm() < 1e-12 * g.norm());
    CHECK(total_moment(x, g).norm() < 1e-12 * g.norm());
  }
}

// The areas of a moving boundary follow its steps; motion within a step is neglected.
TEST_CASE("pressure on an open sheet uses the areas at the start of a step, with an error of second order", "[loads]") {
  TestScene s(scene(cases[1]));
  World& world = *s.world;
  RandomMotions random(6);
  const VecX direction = random.vectors(world.start.x.size());
  const auto& term = dynamic_cast<const VolumeTerm&>(load_of(world));
  double before = 0;
  for (const double step : {0.0, 1e-3, 2e-3}) {
    world.participants.begin_step({world.start.x, 0, 0});
    const VecX x = world.start.x + step * direction;
    VecX forces = VecX::Zero(x.size());
    term.surface().add_areas(x, 200, forces);
    const double off = (dense_gradient(term, x) + forces).norm() / forces.norm();
    if (step == 0) CHECK(off < 1e-12);
    if (step == 2e-3) CHECK(off == Approx(2 * before).epsilon(0.1));
    before = off;
  }
}

// For a solid: - p / K, with the bulk modulus at small strain.
TEST_CASE("a block under a pressure all around shrinks by p over the bulk modulus, whatever the unit, solver and projection", "[loads]") {
  const double p = 100, young = 1e5, nu = 0.3, bulk = young / (3 * (1 - 2 * nu));
  for (const double unit : {1e-3, 1.0, 1e3})
    for (const char* solver : {"{type: projected_newton, stopping: force, force_tolerance: 1e-8}",
                               "{type: projected_newton, projection: clamp, stopping: force, force_tolerance: 1e-8}",
                               "{type: projected_newton, linear: pcg, projection: absolute, stopping: force, force_tolerance: 1e-8}"}) {
      INFO(unit << " " << solver);
      const std::string size = scaled(unit, 0.1);
      TestRun run("time: {step: 1, duration: 1, integrator: quasi_static}\nsolver: " + std::string(solver) +
                  "\nobjects:\n  - {name: it, shape: {type: box, size: [" + size + "," + size + "," + size +
                  "], cells: [2, 2, 2]}, energies: [{type: neo_hookean, young: 1e5, poisson: 0.3, density: 1000}], loads: [{type: pressure, value: 100}],\n"
                  "     motion: [{type: fixed, along: [1, 0, 0], select: {type: face, direction: [1, 0, 0]}}, {type: fixed, along: [0, 1, 0], select: {type: face, "
                  "direction: [0, 1, 0]}}, {type: fixed, along: [0, 0, 1], select: {type: face, direction: [0, 0, 1]}}]}\n"
                  "probes: [{name: v, type: chamber, chamber: it, quantity: volume}]\n");
      const double before = run.sample(0).front();
      run.step();
      CHECK(run.sample(0).front() / before - 1 == Approx(-p / bulk).epsilon(2e-3));
    }
}

TEST_CASE("a torque spins a free body by M t / I about its axis, and its work equals the kinetic energy", "[loads]") {
  // 0.1 x 0.2 x 0.1 m of water: about y 2 kg (0.1^2 + 0.1^2) / 12.
  const double inertia = 2 * 0.02 / 12, moment = 0.01;
  for (const char* object : {stone, block}) {
    INFO(object);
    const Case c{"", object, "{type: torque, value: 0.01, axis: [0, 1, 0]}"};
    TestRun run(scene(c, "", "{step: 5 ms, duration: 1, integrator: newmark}"));
    double work = 0;
    while (run.state().time < 0.5 - 1e-9) work += run.step().flows.loads;
    const double speed = moment * 0.5 / inertia;
    Vec3 angular = Vec3::Zero(), momentum = Vec3::Zero();
    const World& world = *run.world;
    const Vec3 centre = world.centre_of_mass(0, run.state().x);
    for (int v = 0; v < world.mass.size(); ++v) {
      angular += world.mass(v) * (vertex(run.state().x, v) - centre).cross(Vec3(vertex(run.state().v, v)));
      momentum += world.mass(v) * vertex(run.state().v, v);
    }
    CHECK(momentum.norm() < 1e-6);
    CHECK(angular.y() == Approx(moment * 0.5).epsilon(1e-3));
    CHECK(angular.cross(Vec3::UnitY()).norm() < 2e-3 * moment * 0.5);
    if (object == stone) CHECK(work == Approx(inertia * speed * speed / 2).epsilon(1e-3));
  }
}

// m v' = m g - rho c_d A v^2 / 2.
TEST_CASE("a sheet that falls in air has the speed of the closed form", "[loads]") {
  const double g = 9.81, terminal = std::sqrt(2 * 0.5 * g / (1.2 * 1.3));  // 0.5 kg/m^2
  for (const char* integrator : {"newmark", "implicit_euler"}) {
    INFO(integrator);
    TestRun run(fmt::format("time: {{step: 5 ms, duration: 1, integrator: {}}}\ngravity: [0, -9.81, 0]\nobjects:\n  - {{name: it, shape: {{type: grid, size: [0.2, 0.2], cells: [2, 2]}}, "
                            "shell: {{thickness: 1 mm}}, energies: [{{type: neo_hookean_membrane, young: 1 MPa, density: 500}}], loads: [{{type: wind, drag: 1.3}}]}}\n",
                            integrator));
    while (run.state().time < 0.5 - 1e-9) run.step();
    CHECK(-run.state().v(1) == Approx(terminal * std::tanh(g * 0.5 / terminal)).epsilon(integrator[0] == 'n' ? 1e-3 : 1e-2));
  }
}

// Over 1/2 rho c_d U^2 times the frontal area. Each surface counts once: the lee of closed surfaces carries no pressure.
TEST_CASE("the drag of wind on solids, sheets and affine bodies is that of modified Newtonian flow", "[loads]") {
  const std::string solid = "energies: [{type: neo_hookean, young: 0.1 MPa, density: 1000}]", affine = "body: {type: affine, density: 1000}",
                    film = "shell: {thickness: 1 mm}, energies: [{type: neo_hookean_membrane, young: 1 MPa, density: 1000}]";
  const std::string cube = "shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}, ", ball = "shape: {type: sphere, radius: 0.1, cells: 12}, ",
                    rod = "shape: {type: cylinder, radius: 0.1, height: 0.3, cells_across: 16, cells_along: 2}, ", turned = "place: {axis: [0, 1, 0], angle: 45 deg}, ";
  constexpr double pi = 3.14159265358979;
  struct Shape {
    std::string object;
    double frontal_area, drag, within;  // m^2, 1, relative
  };
  const Shape shapes[] = {{cube + solid, 0.04, 1, 1e-9},
                          {cube + affine, 0.04, 1, 1e-9},
                          {"shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2], surface: true}, " + film, 0.04, 1, 1e-9},
                          {cube + turned + solid, 0.04 * std::sqrt(2), 0.5, 1e-9},
                          {ball + solid, pi * 0.01, 0.5, 0.03},
                          {ball + affine, pi * 0.01, 0.5, 0.03},
                          {"shape: {type: sphere, radius: 0.1, cells: 12, surface: true}, " + film, pi * 0.01, 0.5, 0.03},
                          {rod + solid, 0.06, 2.0 / 3, 0.03},
                          {"shape: {type: grid, size: [0.2, 0.2], cells: [2, 2]}, place: {axis: [0, 0, 1], angle: 90 deg}, " + film, 0.04, 1, 1e-9},
                          {"shape: {type: grid, size: [0.2, 0.2], cells: [2, 2]}, place: {axis: [0, 0, 1], angle: -90 deg}, " + film, 0.04, 1, 1e-9}};
  for (const Shape& shape : shapes)
    for (const double speed : {10.0, -10.0}) {
      INFO(shape.object << " " << speed);
      TestScene s(scene({"", shape.object.c_str(), fmt::format("{{type: wind, velocity: [{}, 0, 0], drag: 1.3}}", speed).c_str()}));
      World& world = *s.world;
      const VecX& x = world.start.x;
      const EndVelocity velocity{100, x};
      world.participants.begin_step({x, 0.2, 0.01, &velocity, &world.start.v});
      VecX forces = VecX::Zero(x.size());
      load_of(world).add_forces(x, 1, forces);
      const double unit = 0.5 * 1.2 * 1.3 * speed * std::abs(speed) * shape.frontal_area;
      CHECK(total(forces).x() / unit == Approx(shape.drag).epsilon(shape.within));
      CHECK(total(forces).cross(Vec3::UnitX()).norm() < 1e-9 * std::abs(unit));
    }
}

// A box of 3 x 3 x 3 cells without the one in its middle.
TEST_CASE("wind does not reach the walls of a cavity", "[loads]") {
  Mesh mesh = box_tets({0.3, 0.3, 0.3}, {3, 3, 3});
  std::erase_if(mesh.tets, [&](const Tet& t) {
    Vec3 middle = Vec3::Zero();
    for (const int v : t) middle += mesh.vertices[v] / 4;
    return middle.cwiseAbs().maxCoeff() < 0.05;
  });
  Body body;
  body.name = "hollow";
  body.vertex_count = static_cast<int>(mesh.vertices.size());
  body.triangles = extract_surface(mesh).triangles;
  VecX rest(3 * body.vertex_count);
  for (int v = 0; v < body.vertex_count; ++v) vertex(rest, v) = mesh.vertices[v];
  REQUIRE(body.triangles.size() == 6 * 18 + 6 * 2);
  const ExposedTriangles exposed = exposed_triangles(*Registry<Selection>::make("all"), {body, rest});
  CHECK(exposed.open.empty());
  CHECK(exposed.closed.size() == 6 * 18);
}

TEST_CASE("a field has the forces of its formula: weight, a spring, a damper", "[loads]") {
  const auto fall = [](const std::string& load, const std::string& more, int steps) {
    TestRun run("time: {step: 5 ms, duration: 10, integrator: newmark}\n" + more + "objects:\n  - {name: it, " + std::string(stone) + ", velocity: [0, 1, 0]" +
                (load.empty() ? "" : ", loads: [" + load + "]") + "}\n");
    while (run.state().time < 5e-3 * steps - 1e-9) run.step();
    return run.world->centre_of_mass(0, run.state().x).y() - run.world->centre_of_mass(0, run.world->rest).y();
  };
  const double weight = fall("", "gravity: [0, -9.81, 0]\n", 40);
  CHECK(fall("{type: field, y: -9.81}", "", 40) == Approx(weight).epsilon(1e-5));
  CHECK(fall("{type: field, y: -9810, per: volume}", "", 40) == Approx(weight).epsilon(1e-5));
  CHECK(fall("{type: field, y: -F, per: object, parameters: {F: 19.62 N}}", "", 40) == Approx(weight).epsilon(1e-5));
  // sin(w t) / w, and (1 - exp(-c t)) / c.
  CHECK(fall("{type: field, y: -100 * y}", "", 60) == Approx(std::sin(10 * 0.3) / 10).margin(2e-4));
  CHECK(fall("{type: field, y: -3 * vy}", "", 60) == Approx((1 - std::exp(-0.9)) / 3).epsilon(1e-3));
}

// For each load, the energy balance of a step without losses closes up to the integrator's error, which falls with the step size.
TEST_CASE("the work of following loads equals the energy of the bodies", "[loads]") {
  for (const Case& c : cases) {
    INFO(c.name);
    double missing[2];
    for (int k = 0; k < 2; ++k) {
      const int steps = 10 << k;
      TestRun run(scene(c, "", fmt::format("{{step: {} ms, duration: 1, integrator: newmark}}", 2.0 / (1 << k))));
      double numerics = 0, most = 0;
      for (int i = 0; i < steps; ++i) {
        const StepReport r = run.step();
        numerics += r.flows.numerics + r.flows.areas;
        most = r.flows.reference_energy;
      }
      missing[k] = std::abs(numerics) / most;
    }
    CHECK((missing[1] < 2e-3 || missing[1] < 0.6 * missing[0]));
    CHECK(missing[1] < 0.05);
  }
}

TEST_CASE("following loads report wrong parameters", "[loads]") {
  const auto refused = [](const char* object, const char* load) -> std::string {
    try {
      TestScene s(scene({"", object, load}));
      return "";
    } catch (const InputError& error) {
      return error.what();
    }
  };
  const auto has = [](const std::string& text) { return Catch::Matchers::Contains(text); };
  CHECK_THAT(refused(sheet, "{type: chamber, content: {type: gas}}"), has("boundary that nothing closes"));
  CHECK_THAT(refused(block, "{type: chamber, content: {type: gas}}"), has("wrong side of the faces of solids"));
  CHECK_THAT(refused(balloon, "{type: chamber, content: {type: gas, ambient: 0}}"), has("pressure at rest"));
  CHECK_THAT(refused(balloon, "{type: pressure, value: 1, select: {type: indices, vertices: [0]}}"), has("complete triangle"));
  CHECK_THAT(refused(balloon, "{type: pressure, value: 1}, {type: chamber, content: {type: gas}}"), has("another name"));
  CHECK_THAT(refused(balloon, "{type: pressure, value: 1 m}"), has("pressure"));
  CHECK_THAT(refused(block, "{type: torque, value: 1, select: {type: indices, vertices: [0]}}"), has("lies on its axis"));
  CHECK_THAT(refused(block, "{type: field, x: q * 2}"), has("q"));
  CHECK_THAT(refused(block, "{type: field, x: x, parameters: {x: 1}}"), has("something else"));
  CHECK_THAT(refused("shape: {type: segment, length: 1, edges: 4}, rod: {radius: 1 mm}, energies: [{type: elastic_rod, young: 1 MPa}]", "{type: wind, velocity: [1, 0, 0]}"),
             has("no whole triangle of an outer surface"));
  CHECK_THAT(refused(stone, "{type: field, x: x, select: {type: face, direction: [1, 0, 0]}}"), has("affine"));
}
