// Sheets against the theory of plane stress, beams, the elastica and plates.
#include <catch2/catch.hpp>
#include <cmath>
#include <fmt/format.h>
#include <tbb/global_control.h>

#include "geometry/parallel.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

constexpr double young = 1e9, thickness = 1e-3, density = 1000;

struct Triangles {
  const char* diagonals;
  double jitter;
};
const std::vector<Triangles> regular_and_not = {{"uniform", 0}, {"uniform", 0.2}, {"alternating", 0}, {"alternating", 0.2}};

// A strip of length 1 along x that weighs q per area, clamped by a further column of cells. What bends begins in the middle
// of that column.
class Strip {
 public:
  Strip(int cells_across, const Triangles& triangles, double q)
      : cell_(0.1 / cells_across),
        run_(fmt::format(
            "time: {{step: 1, duration: 1, integrator: quasi_static}}\n"
            "solver: {{type: projected_newton, linear: cholmod, stopping: force, force_tolerance: 1e-8, max_iterations: 500}}\n"
            "gravity: [0, {}, 0]\nobjects:\n"
            "  - name: strip\n    shape: {{type: grid, size: [{}, {}], cells: [{}, {}], diagonals: {}, jitter: {}}}\n"
            "    place: {{translate: [{}, 0, 0]}}\n    shell: {{thickness: {}}}\n"
            "    energies: [{{type: stvk_membrane, young: {}, poisson: 0, density: {}}},\n"
            "               {{type: hinge_bending, young: {}, poisson: 0}}]\n"
            "    motion: [{{type: fixed, select: {{type: plane, normal: [-1, 0, 0], point: [{}, 0, 0]}}}}]\n",
            -q / (density * thickness), 1 + cell_, 0.1, 10 * cells_across + 1, cells_across, triangles.diagonals, triangles.jitter,
            (1 - cell_) / 2, thickness, young, density, young, 0.2 * cell_)) {
    const StepReport report = run_.step();
    REQUIRE(report.rejections.cutbacks() == 0);
  }

  double length() const { return 1 + cell_ / 2; }
  double tip() const {
    double sum = 0;
    int vertices = 0;
    for (int v = 0; v < run_.world->bodies[0].vertex_count; ++v)
      if (run_.rest(v).x() > 1 - 1e-6) sum += run_.at(v).y(), ++vertices;
    return sum / vertices;
  }

 private:
  double cell_;
  TestRun run_;
};

constexpr double stiffness = young * thickness * thickness * thickness / 12;

// The tip of a clamped elastica under its own weight, D theta'' = q (L - s) cos theta, theta(0) = theta'(L) = 0, by shooting.
double heavy_elastica(double q, double length) {
  struct End {
    double curvature, y;
  };
  const auto shot = [&](double curvature) {
    constexpr int steps = 1000;
    const double h = length / steps;
    Vec3 u(0, curvature, 0);  // theta, theta', y
    const auto rate = [&](double s, const Vec3& at) { return Vec3(at(1), q * (length - s) * std::cos(at(0)) / stiffness, std::sin(at(0))); };
    for (int i = 0; i < steps; ++i) {
      const double s = i * h;
      const Vec3 a = rate(s, u), b = rate(s + h / 2, u + h / 2 * a), c = rate(s + h / 2, u + h / 2 * b), d = rate(s + h, u + h * c);
      u += h / 6 * (a + 2 * b + 2 * c + d);
    }
    return End{u(1), u(2)};
  };
  double low = -q * length * length / stiffness, high = 0;
  for (int i = 0; i < 60; ++i) {
    const double middle = (low + high) / 2;
    (shot(middle).curvature < 0 ? low : high) = middle;
  }
  return shot(low).y;
}

}  // namespace

TEST_CASE("a sheet that is pulled in its plane has Young's modulus and contracts by Poisson's ratio", "[shells]") {
  for (const std::string type : {"stvk_membrane", "neo_hookean_membrane"}) {
    for (const Triangles& t : regular_and_not) {
      INFO(type << " " << t.diagonals << " " << t.jitter);
      const auto roller = [](const std::string& along, const std::string& face) {
        return "{type: fixed, along: " + along + ", select: {type: face, direction: " + face + "}}";
      };
      TestRun run(fmt::format(
          "time: {{step: 1, duration: 1, integrator: quasi_static}}\nsolver: {{type: projected_newton, force_tolerance: 1e-9}}\nobjects:\n"
          "  - name: sheet\n    shape: {{type: grid, size: [0.2, 0.1], cells: [8, 4], diagonals: {}, jitter: {}}}\n"
          "    shell: {{thickness: 1 mm}}\n    energies: [{{type: {}, young: 1e6, poisson: 0.3}}]\n"
          "    motion: [{}, {}, {{type: fixed, along: [0, 1, 0]}},\n"
          "             {{type: translate, along: [1, 0, 0], velocity: [0.2 mm/s, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}]\n"
          "probes: [{{name: force, type: reaction, object: sheet, direction: [1, 0, 0], select: {{type: face, direction: [1, 0, 0]}}}}]\n",
          t.diagonals, t.jitter, type, roller("[1, 0, 0]", "[-1, 0, 0]"), roller("[0, 0, 1]", "[0, 0, -1]")));
      run.step();
      const double strain = 1e-3;
      CHECK(run.sample(0)[0] == Approx(1e6 * strain * 0.1 * 1e-3).epsilon(0.01));
      const int corner = run.world->bodies[0].vertex_count - 1;
      CHECK(run.at(corner).z() - run.rest(corner).z() == Approx(-0.3 * strain * 0.1).epsilon(0.01));
    }
  }
}

TEST_CASE("a strip under little weight bends like a beam", "[shells]") {
  for (const int cells : {2, 4}) {
    for (const Triangles& t : regular_and_not) {
      INFO(cells << " " << t.diagonals << " " << t.jitter);
      const double q = 1e-3;
      const Strip strip(cells, t, q);
      CHECK(strip.tip() == Approx(-q * std::pow(strip.length(), 4) / (8 * stiffness)).epsilon(0.02));
    }
  }
}

TEST_CASE("a strip under much weight bends like the elastica", "[shells]") {
  const double q = 10 * stiffness;
  for (const int cells : {2, 4}) {
    for (const Triangles& t : {regular_and_not.front(), regular_and_not[1], regular_and_not.back()}) {
      INFO(cells << " " << t.diagonals << " " << t.jitter);
      const Strip strip(cells, t, q);
      CHECK(strip.tip() == Approx(heavy_elastica(q, strip.length())).epsilon(0.02));
    }
  }
}

TEST_CASE("a clamped square plate under pressure sinks by 0.00126 p L^4 / D", "[shells]") {
  const double poisson = 0.3, d = stiffness / (1 - poisson * poisson), pressure = 1e-3;
  for (const Triangles& t : regular_and_not) {
    INFO(t.diagonals << " " << t.jitter);
    // Clamped by the two outer rows of vertices; what bends ends in the middle between them.
    constexpr int n = 34;
    const double side = 1 + 1.0 / (n - 2);
    std::string held;
    for (int k = 0; k <= n; ++k)
      for (int i = 0; i <= n; ++i)
        if (std::min(i, k) <= 1 || std::max(i, k) >= n - 1) held += fmt::format("{}{}", held.empty() ? "" : ", ", i + (n + 1) * k);
    TestRun run(fmt::format(
        "time: {{step: 1, duration: 1, integrator: quasi_static}}\nobjects:\n"
        "  - name: plate\n    shape: {{type: grid, size: [{0}, {0}], cells: [{1}, {1}], diagonals: {2}, jitter: {3}}}\n"
        "    shell: {{thickness: {4}}}\n"
        "    energies: [{{type: stvk_membrane, young: {5}}}, {{type: hinge_bending, young: {5}}}]\n"
        "    motion: [{{type: fixed, select: {{type: indices, vertices: [{6}]}}}}]\n"
        "    loads: [{{type: traction, value: [0, {7}, 0]}}]\n",
        double(n) / (n - 2), n, t.diagonals, t.jitter, thickness, young, held, -pressure));
    run.step();
    const double middle = run.at((n / 2) * (n + 2)).y();
    CHECK(middle == Approx(-0.00126532 * pressure * std::pow(side, 4) / d).epsilon(0.03));
  }
}

TEST_CASE("a sheet with a curved rest shape bends from that shape if the scene says so", "[shells]") {
  const auto energy = [](const std::string& rest) {
    TestRun run("time: {step: 1 ms, duration: 1}\nobjects:\n  - name: box\n    shape: {type: box, size: [0.1, 0.1, 0.1], cells: [3, 3, 3], surface: true}\n"
                "    shell: {thickness: 1 mm}\n    energies: [{type: stvk_membrane, young: 1e6}, {type: hinge_bending, young: 1e6, rest: " + rest + "}]\n");
    return run.world->elastic_terms[1]->value(run.world->rest);
  };
  CHECK(energy("mesh") == 0);
  CHECK(energy("flat") > 1e-6);
}

TEST_CASE("a sheet that flaps, flows and is damped has the same bits for 1 and 2 threads", "[shells]") {
  const auto run = [](int threads) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(threads));
    TestRun scene(
        "time: {step: 0.01, duration: 1}\ngravity: [0, -9.81, 0]\nobjects:\n"
        "  - name: sheet\n    shape: {type: grid, size: [0.3, 0.3], cells: [24, 24], jitter: 0.2}\n    shell: {thickness: 1 mm}\n"
        "    energies: [{type: von_mises_membrane, young: 1e6, yield_stress: 1e3}, {type: hinge_bending, young: 1e6}]\n"
        "    damping: {stiffness: 1 ms, mass: 1}\n"
        "    motion: [{type: fixed, select: {type: face, direction: [1, 0, 1]}}]\n");
    for (int i = 0; i < 5; ++i) scene.step();
    REQUIRE(scene.world->elastic_terms[0]->batches()[0].count > 4 * chunk_size);
    CHECK(scene.state().energy.dissipated_as("dissipated_plastic") > 0);
    CHECK(scene.state().history.count("sheet/energies/0/plastic_inverse"));
    return scene.state();
  };
  const State one = run(1), again = run(1), two = run(2);
  CHECK(one.x == again.x);
  CHECK(one.x == two.x);
  CHECK(one.history == two.history);
}
