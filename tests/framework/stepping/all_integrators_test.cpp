// Properties that every registered integrator has, those of plugins included: order, rest, same
// bits, adaptive steps, prescribed motion, failed steps. Resumption: resumption_test.cpp.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <map>
#include <tbb/global_control.h>

#include "framework/world/energy_records.hpp"
#include "geometry/errors.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/same_state.hpp"
#include "tests/support/sliding_block.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

std::vector<std::string> dynamic_integrators() {
  std::vector<std::string> names;
  for (const std::string& name : Registry<TimeIntegrator>::kind().names())
    if (Registry<TimeIntegrator>::make(name)->inertia()) names.push_back(name);
  return names;
}

std::string time_of(const std::string& integrator, double h, const std::string& more = "") {
  return fmt::format("time: {{step: {}, duration: 10, integrator: {}{}}}\n", h, integrator, more);
}
const std::string precise = "solver: {type: projected_newton, tolerance: 1e-9, force_tolerance: 1e-9}\n";

std::string sliding(const std::string& integrator, double h, const std::string& solver = "solver: {type: projected_newton, linear: cholmod, tolerance: 1e-6}\n") {
  return time_of(integrator, h) + solver + sliding_block;
}

}  // namespace

TEST_CASE("every integrator has its order without contact", "[integrators]") {
  const auto end = [](const std::string& integrator, int steps) {
    constexpr double duration = 0.02;  // s
    TestRun run(time_of(integrator, duration / steps) + precise +
                "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 2e4}],\n"
                "  velocity: [1 mm/s, 0.2 mm/s, 0], motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}]\n");
    for (int i = 0; i < steps; ++i) run.step();
    return run.state().x;
  };
  for (const std::string& integrator : dynamic_integrators()) {
    const VecX coarse = end(integrator, 50), middle = end(integrator, 100), fine = end(integrator, 200);
    const double order = std::log2((coarse - middle).norm() / (middle - fine).norm());
    INFO(integrator << ": order " << order);
    const std::map<std::string, double> orders = {{"implicit_euler", 1}, {"documented_sdirk3", 3}};  // others: 2
    CHECK(order == Approx(orders.contains(integrator) ? orders.at(integrator) : 2).margin(0.15));
  }
}

TEST_CASE("every integrator gives the same bits for any number of threads", "[integrators]") {
  const auto end = [](const std::string& integrator, int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    TestRun run(sliding(integrator, 2e-3));
    for (int i = 0; i < 12; ++i) run.step();
    return run.state();
  };
  for (const std::string& integrator : dynamic_integrators()) {
    INFO(integrator);
    CHECK(first_difference(end(integrator, 1), end(integrator, 2)) == "");
  }
}

TEST_CASE("a step that fails in any stage leaves the state at its start", "[integrators]") {
  for (const std::string& integrator : dynamic_integrators()) {
    int thrown = 0, cut_back = 0;
    for (int iterations = 1; iterations <= 6; ++iterations) {
      INFO(integrator << ", " << iterations << " iterations");
      const std::string solver = fmt::format("solver: {{type: projected_newton, tolerance: 1e-9, max_iterations: {}}}\n", iterations);
      TestRun run(sliding(integrator, 4e-3, solver));
      State before = run.state();
      try {
        for (int i = 0; i < 8; ++i) {
          before = run.state();
          cut_back += run.step().rejections.cutbacks();
        }
      } catch (const SimulationError&) {
        ++thrown;
        before.step_size = run.state().step_size;
        CHECK(first_difference(run.state(), before) == "");
      }
      // The next step is that of a run that begins there.
      TestRun fresh(sliding(integrator, 4e-3)), after(sliding(integrator, 4e-3));
      fresh.simulation.start_from(before);
      after.simulation.start_from(run.state());
      if (run.state().step == before.step) {
        fresh.step(), after.step();
        CHECK(first_difference(fresh.state(), after.state()) == "");
      }
    }
    INFO(integrator);
    CHECK(thrown + cut_back > 0);
  }
}

TEST_CASE("adaptive steps of every integrator come to rest where constant ones do", "[integrators]") {
  const auto end = [](const std::string& integrator, const std::string& adaptive) {
    TestRun run(time_of(integrator, adaptive.empty() ? 0.05e-3 : 0.5e-3, adaptive) + precise +
                "objects: [{name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, energies: [{type: neo_hookean, young: 2e4}],\n"
                "  velocity: [10 mm/s, 2 mm/s, 0], motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}]\n");
    int steps = 0;
    while (run.state().time < 0.02 * (1 - 1e-9) && ++steps < 5000) run.step();
    return std::pair(run.probes.empty() ? run.state().x : VecX(), run.state().time);
  };
  const auto [exact, time] = end("newmark", "");
  for (const std::string& integrator : dynamic_integrators()) {
    double before = std::numeric_limits<double>::infinity();
    for (const double error : {1e-6, 1e-8}) {
      // Steps end at multiples of the largest size.
      const auto [x, until] = end(integrator, fmt::format(", adaptive: {{error: {}, largest: 0.5e-3}}", error));
      INFO(integrator << ", error " << error << ": " << (x - exact).lpNorm<Eigen::Infinity>() << " m at " << until << " s");
      if (std::abs(until - time) > 1e-12) continue;
      const double distance = (x - exact).lpNorm<Eigen::Infinity>();
      CHECK(distance <= std::max(100 * error, 2e-7));
      CHECK(distance <= before * 1.01);
      before = distance;
    }
  }
}

TEST_CASE("prescribed motion is where it has to be after every step of every integrator", "[integrators]") {
  std::map<std::string, VecX> ends;
  for (const std::string& integrator : Registry<TimeIntegrator>::kind().names()) {
    INFO(integrator);
    TestRun run(time_of(integrator, 2e-3) +
                "objects:\n"
                "  - {name: bar, shape: {type: box, size: [0.2, 0.02, 0.02], cells: [4, 1, 1]}, energies: [{type: neo_hookean, young: 1e6}],\n"
                "     motion: [{type: fixed, select: {type: face, direction: [-1, 0, 0]}},\n"
                "              {type: translate, velocity: [0.3, 0.2, 0], from: 5 ms, until: 15 ms, select: {type: face, direction: [1, 0, 0]}}]}\n");
    const auto right = [&](int v) { return run.rest(v).x() > 0.0999; };
    while (run.state().time < 0.024 * (1 - 1e-9)) {
      run.step();
      const double t = run.state().time, moving = std::clamp(t, 5e-3, 15e-3) - 5e-3;
      for (int v = 0; v < run.world->rest.size() / 3; ++v) {
        // A motion acts in steps whose middle it contains.
        if (run.rest(v).x() < -0.0999) CHECK(run.at(v) == run.rest(v));
        else if (right(v) && t > 6e-3 && t < 14.5e-3) CHECK((run.at(v) - run.rest(v) - moving * Vec3(0.3, 0.2, 0)).norm() <= 0.3 * 2e-3);
      }
    }
    VecX fixed = VecX::Zero(run.state().x.size());
    for (int v = 0; v < fixed.size() / 3; ++v)
      if (!run.world->dofs.moves(v)) vertex(fixed, v) = run.at(v);
    ends[integrator] = fixed;
  }
  for (const auto& [integrator, end] : ends) {
    INFO(integrator);
    CHECK(end == ends.at("implicit_euler"));
  }
}

TEST_CASE("a block that rests under its weight stays where it is with every integrator", "[integrators]") {
  const auto scene = [](const std::string& integrator, const std::string& more) {
    return time_of(integrator, 5e-3) + precise +
           "gravity: [0, -9.81, 0]\n"
           "objects:\n"
           "  - {name: floor, shape: {type: box, size: [0.5, 0.02, 0.5]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
           "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.0508, 0]}, energies: [{type: neo_hookean, young: 1e6}]" + more + "}\n"
           "contact: {distance: 1 mm, friction: {mu: 0.5}}\n";
  };
  TestRun settling(scene("implicit_euler", ", damping: {mass: 100}"));
  for (int i = 0; i < 200; ++i) settling.step();
  for (const std::string& integrator : dynamic_integrators()) {
    TestRun run(scene(integrator, ""));
    const VecX x = settling.state().x, still = VecX::Zero(x.size());
    run.simulation.move(x, still);
    double moved = 0;
    for (int i = 0; i < 20; ++i) {
      run.step();
      moved = std::max(moved, (run.state().x - x).lpNorm<Eigen::Infinity>());
    }
    INFO(integrator << ": moved by " << moved << " m");
    CHECK(moved <= 1e-6);  // the first step knows no earlier force of contact
  }
}

// The rule is conjugate to the midpoint rule, which keeps the angular momentum.
TEST_CASE("Newmark's rule keeps the angular momentum plus h^2/4 sum m v x a in free motion", "[integrators]") {
  constexpr double h = 2e-3;
  TestRun run(time_of("newmark", h) + "solver: {type: projected_newton, tolerance: 1e-11, force_tolerance: 1e-12}\n" +
              "objects: [{name: block, shape: {type: box, size: [0.1, 0.07, 0.05]}, spin: [2, 5, -3], energies: [{type: neo_hookean, young: 1e5}]}]\n");
  const auto momenta = [&] {
    std::array<Vec3, 2> sums{Vec3::Zero(), Vec3::Zero()};
    for (int v = 0; v < run.world->mass.size(); ++v) {
      const Vec3 x = run.at(v), velocity = vertex(run.state().v, v), a = vertex(run.state().a, v);
      sums[0] += run.world->mass(v) * x.cross(velocity);
      sums[1] += run.world->mass(v) * (x.cross(velocity) + h * h / 4 * velocity.cross(a));
    }
    return sums;
  };
  const auto start = momenta();
  double plain = 0, corrected = 0;
  for (int i = 0; i < 100; ++i) {
    run.step();
    const auto now = momenta();
    plain = std::max(plain, (now[0] - start[0]).norm() / start[0].norm());
    corrected = std::max(corrected, (now[1] - start[1]).norm() / start[0].norm());
  }
  INFO(plain << " " << corrected);
  CHECK(plain > 1e-5);
  CHECK(corrected <= 1e-7);
}
