// Friction of `model: stick`: derivatives, return mapping, anchors under rigid motion, blocks on
// slopes, history, refusals.
#include <Eigen/Geometry>
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>

#include "framework/contact/terms/friction_term.hpp"
#include "framework/output/state_file.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "geometry/errors.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/error_of.hpp"
#include "tests/support/program.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"
#include "tests/support/tet_body.hpp"
#include "tests/support/three_boxes.hpp"

using namespace tack;

namespace {

constexpr double elastic_slip = 1e-3;  // m, of the boxes

// Three small boxes around each other, askew, after a step by `first` and in one by `slip`.
struct Cluster {
  Cluster(double first, double slip)
      : scene(three_boxes() + "contact:\n  distance: 0.025\n  safety_barrier: 1\n"
                              "  friction: {model: stick, mu: 0.7, mu_static: 0.9, elastic_slip: 1e-3}\n"
                              "  barrier: {type: clamped_log, stiffness: 1e3}\n") {
    RandomMotions random(5);
    start = scene.world->rest + 1e-3 * random.vectors(scene.world->rest.size());
    step(start, start + first * random.vectors(start.size()));
    x = start + slip * random.vectors(start.size());
  }
  // Makes a step from one configuration to the next, and begins another one there.
  void step(const VecX& from, const VecX& to) {
    begin(from);
    term().commit(to, history);
    term().load_history(history);
    start = to;
    begin(to);
  }
  void begin(const VecX& at) {
    system().begin_step({at});
    system().move_to(at);
    term().begin_step({at, 0, 0.5});
    term().lag(at);
  }
  ContactSystem& system() { return *scene.world->contact; }
  FrictionTerm& term() { return *scene.world->friction; }
  std::vector<double> elastic() {
    std::vector<double> sizes;
    for_each_record(term().points(), [&](const auto& c) { sizes.push_back(c.elastic.norm()); });
    return sizes;
  }

  TestScene scene;
  History history;
  VecX start, x;
};

constexpr double g = 9.81, mass = 1;

// A block of 1 kg on a slope of tan(theta) = 0.5. (0.2 x 0.1 m, 0.8387 mm above, where the barrier carries it.)
std::string slope(double mu, const std::string& time, const std::string& friction = "", const std::string& solver = "projected_newton") {
  return fmt::format(
      "time: {}\n"
      "objects:\n"
      "  - {{name: slope, shape: {{type: box, size: [1, 0.02, 0.3], cells: [7, 1, 3]}}, motion: [fixed],\n"
      "     place: {{axis: [0, 0, 1], angle: -26.565051 deg, translate: [-0.004472136, -0.008944272, 0]}}}}\n"
      "  - {{name: block, shape: {{type: box, size: [0.2, 0.005, 0.1], cells: [4, 1, 2]}}, body: {{type: affine, density: 10000, stiffness: 100 MPa}},\n"
      "     place: {{axis: [0, 0, 1], angle: -26.565051 deg, translate: [0.00149311, 0.00298622, 0]}},\n"
      "     loads: [{{type: body_force, value: [0, -9.81, 0]}}]}}\n"
      "contact: {{distance: 1 mm, barrier: {{type: clamped_log, stiffness: 5 kPa}}, friction: {{model: stick, mu: {}{}}}}}\n"
      "solver: {{type: {}}}\n",
      time, mu, friction, solver);
}

// Displacement of the block down the slope [m].
double slid(const World& world, const VecX& x) {
  const Vec3 down = Vec3(2, -1, 0).normalized();
  double sum = 0, all = 0;
  for (const int v : world.vertices_of(1)) sum += world.mass(v) * (vertex(x, v) - vertex(world.rest, v)).dot(down), all += world.mass(v);
  return sum / all;
}

}  // namespace

TEST_CASE("sticking friction: gradient and Hessian are those of the value, with anchors of the step before", "[friction][stick]") {
  for (const double slip : {1e-6, 2e-4, 1.5e-3, 1e-2}) {
    INFO("slip " << slip);
    Cluster c(4e-4, slip);
    const std::vector<double> elastic = c.elastic();
    CHECK(std::count_if(elastic.begin(), elastic.end(), [](double e) { return e > 1e-5; }) > 20);
    const VecX gradient = dense_gradient(c.term(), c.x);
    const MatX hessian = dense_hessian(c.term(), c.x, Projection::none);
    const VecX slopes = gradient_by_differences([&](const VecX& y) { return c.term().value(y); }, c.x, 1e-8);
    const MatX curvatures = hessian_by_differences([&](const VecX& y) { return dense_gradient(c.term(), y); }, c.x, 1e-9);
    CHECK((slopes - gradient).lpNorm<Eigen::Infinity>() <= 1e-6 * gradient.lpNorm<Eigen::Infinity>());
    CHECK((curvatures - hessian).cwiseAbs().maxCoeff() <= 1e-5 * hessian.cwiseAbs().maxCoeff());
    for_each_stencil_hessian(c.term(), c.x, Projection::clamp, [&](const MatX& h, const int*) { CHECK(smallest_eigenvalue(h) >= -1e-9 * h.norm()); });
  }
}

TEST_CASE("sticking friction: the return mapping cuts the slip to the elastic one", "[friction][stick]") {
  Cluster c(1e-2, 0);
  const std::vector<double> elastic = c.elastic();
  CHECK(*std::max_element(elastic.begin(), elastic.end()) == Approx(elastic_slip));
  // The force at rest is that of the springs.
  CHECK(c.term().forces(c.start, TangentialTerm::all).norm() > 0);
}

TEST_CASE("sticking friction: anchors follow a rigid motion of all bodies", "[friction][stick]") {
  Cluster c(4e-4, 0);
  const std::vector<double> before = c.elastic();
  const VecX at = c.start;
  VecX x = at;
  for (int k = 1; k <= 8; ++k) {  // steps of 10 degrees, about an axis and a spin about it
    const Mat3 turn = Eigen::AngleAxisd(k * 0.17, Vec3(0.3, 1, -0.4).normalized()).toRotationMatrix();
    VecX next = at;
    for (int v = 0; v < at.size() / 3; ++v) vertex(next, v) = turn * vertex(at, v) + Vec3(0.01 * k, 0, 0);
    // The slip of a step is that of a fixed plane, which such a turn moves by a fraction of the gap:
    // the anchors of the step are those of its start.
    c.term().commit(x, c.history);
    c.term().load_history(c.history);
    c.begin(next);
    x = next;
  }
  const std::vector<double> after = c.elastic();
  REQUIRE(after.size() == before.size());
  double difference = 0;
  for (size_t i = 0; i < after.size(); ++i) difference = std::max(difference, std::abs(after[i] - before[i]));
  CHECK(difference <= 1e-9);
}

TEST_CASE("a block of friction that sticks stays on a slope for an hour", "[friction][stick]") {
  TestRun run(slope(0.6, "{step: 2 s, duration: 3600 s}", ", elastic_slip: 10 um"));
  double settled = 0, farthest = 0;
  while (run.state().step < 1800) {
    run.step();
    const double now = slid(*run.world, run.state().x);
    if (run.state().step == 30) settled = now;
    farthest = std::max(farthest, now);
  }
  // The fraction a = 0.5 / 0.6 of the limit is at the slip l (1 - sqrt(1 - a)).
  CHECK(settled == Approx(10e-6 * (1 - std::sqrt(1 - 0.5 / 0.6))).epsilon(0.02));
  CHECK(farthest <= 10e-6);
  CHECK(std::abs(slid(*run.world, run.state().x) - settled) <= 1e-12);
}

TEST_CASE("a block of friction that sticks slides on a slope steeper than its angle of friction", "[friction][stick]") {
  const double mu = 0.4, time = 0.5, acceleration = g / std::sqrt(5) * (1 - 2 * mu);
  for (const std::string integrator : {"implicit_euler", "bdf2"}) {
    INFO(integrator);
    TestRun run(slope(mu, "{step: 2 ms, duration: 0.5 s, integrator: " + integrator + "}"));
    while (run.state().step < 250) run.step();
    CHECK(slid(*run.world, run.state().x) == Approx(acceleration * time * time / 2).epsilon(0.02));
  }
}

TEST_CASE("friction that sticks: static friction holds more than kinetic friction", "[friction][stick]") {
  for (const double mu_static : {0.55, 0.45}) {
    TestRun run(slope(0.3, "{step: 10 ms, duration: 1 s}", fmt::format(", mu_static: {}", mu_static)));
    while (run.state().step < 100) run.step();
    if (mu_static > 0.5) CHECK(slid(*run.world, run.state().x) <= 10e-6);
    else CHECK(slid(*run.world, run.state().x) > 0.1);
  }
}

TEST_CASE("friction that sticks: another minimiser and a resumed run give the same", "[friction][stick]") {
  const std::string time = "{step: 20 ms, duration: 1 s}";
  const auto end_of = [&](const std::string& solver, int from) {
    const TemporaryFolder folder;
    auto run = std::make_unique<TestRun>(slope(0.6, time, "", solver));
    while (run->state().step < 30) {
      run->step();
      if (run->state().step != from) continue;
      StateFile file;
      file.kind = StateFile::Kind::checkpoint;
      file.state = run->state();
      write_state_file(folder.path() / "state", file);
      run = std::make_unique<TestRun>(slope(0.6, time, "", solver));
      run->simulation.start_from(read_state_file(folder.path() / "state", StateFile::Kind::checkpoint).state);
    }
    return State(run->state());
  };
  const State whole = end_of("projected_newton", -1);
  CHECK(whole.history.at(StickAnchors::history_name).entries() > 0);
  const State resumed = end_of("projected_newton", 17);
  CHECK((whole.x - resumed.x).lpNorm<Eigen::Infinity>() <= 1e-12);
  const State other = end_of("lbfgs", -1);
  CHECK((whole.x - other.x).lpNorm<Eigen::Infinity>() <= 2e-7);
}

TEST_CASE("friction that sticks refuses what it does not support", "[friction][stick]") {
  const std::string boxes = "objects:\n  - {name: floor, shape: {type: box, size: [1, 1, 1]}, motion: [fixed]}\n"
                            "  - {name: ball, shape: {type: points, size: [0, 0, 0], counts: [1, 1, 1]}, particle: {radius: 5 mm}, contact_offset: 5 mm,\n"
                            "     place: {translate: [0, 0.51, 0]}, energies: [{type: particle, density: 10000, rolling: true}]}\n";
  CHECK(error_of<TestScene>(boxes + "contact: {friction: {model: stick, mu: 0.5}}\n").find("'ball' rolls") != std::string::npos);
  CHECK(error_of<TestScene>(boxes + "contact: {friction: {model: stick, mu: 0.5, eps_v: 1 mm/s}}\n").find("is of smoothed friction") != std::string::npos);
  CHECK(error_of<TestScene>(boxes + "contact: {friction: {mu: 0.5, elastic_slip: 1 um}}\n").find("model: stick") != std::string::npos);
  const std::string adheres = three_boxes() + "contact: {friction: {model: stick, mu: 0.5}, pairs: [{between: [a, b], adhesion: {type: fang, peak_traction: 1 kPa}, tangential_adhesion: {mu: 1}}]}\n";
  CHECK(error_of<TestScene>(adheres).find("take tangential_adhesion away") != std::string::npos);
}
