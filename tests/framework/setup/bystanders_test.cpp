// Bodies that cannot meet another body do not change its stiffness, tolerance or motion.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/output/used_stiffness.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

struct Kind {
  const char* name;
  const char* yaml;  // an entry of `objects`
};

// Each lands on the floor at 0.5 m/s.
constexpr Kind bases[] = {
    {"soft", "  - {name: it, shape: {type: box, size: [0.1, 0.1, 0.1], cells: [2, 2, 2]}, place: {translate: [0, 0.0515, 0]}, velocity: [0.3, -0.5, 0],\n"
             "     energies: [{type: neo_hookean, young: 1e3, poisson: 0.4, density: 1000}]}\n"},
    {"affine", "  - {name: it, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.0515, 0]}, velocity: [0.3, -0.5, 0], body: {type: affine, density: 1000}}\n"},
    {"sheet", "  - {name: it, shape: {type: grid, size: [0.1, 0.1], cells: [3, 3]}, place: {translate: [0, 0.002, 0]}, velocity: [0, -0.5, 0], shell: {thickness: 0.5 mm},\n"
              "     energies: [{type: stvk_membrane, young: 1e6, density: 400}, {type: hinge_bending, young: 1e6}]}\n"},
};

constexpr Kind bystanders[] = {
    {"a slab held 1 km below", "  - {name: slab, shape: {type: box, size: [1, 0.1, 1]}, place: {translate: [100, -1000, 0]}, motion: [fixed]}\n"},
    {"a ton on a floor of its own",
     "  - {name: far_floor, shape: {type: box, size: [2, 0.1, 2]}, place: {translate: [100, 0, 0]}, motion: [fixed]}\n"
     "  - {name: ton, shape: {type: box, size: [1, 1, 1]}, place: {translate: [100, 0.5511, 0]}, body: {type: affine, density: 1000}}\n"},
    {"a fast affine cube", "  - {name: fast, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [100, 0, 0]}, body: {type: affine, density: 7800}, velocity: [50, 0, 0]}\n"},
    {"a fast soft cube", "  - {name: fast, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [100, 0, 0]}, velocity: [50, 0, 0],\n"
                         "     energies: [{type: neo_hookean, young: 1e6, density: 1000}]}\n"},
    {"a tiny cube", "  - {name: tiny, shape: {type: box, size: [1e-4, 1e-4, 1e-4]}, place: {translate: [3, 0, 0]}, body: {type: affine, density: 7800}}\n"},
    {"a sheet", "  - {name: cloth, shape: {type: grid, size: [0.5, 0.5], cells: [2, 2]}, place: {translate: [3, 1, 0]}, shell: {thickness: 1 mm},\n"
                "     energies: [{type: stvk_membrane, young: 1e8, density: 1e4}, {type: hinge_bending, young: 1e8}]}\n"},
    {"a rod", "  - {name: line, shape: {type: segment, length: 0.2, edges: 3}, rod: {radius: 1 mm}, place: {translate: [3, 1, 0]}, velocity: [0, 20, 0],\n"
              "     energies: [{type: elastic_rod, young: 1e8, density: 1e4}]}\n"},
    {"a particle", "  - {name: dust, shape: {type: points}, particle: {radius: 5 mm}, place: {translate: [5, 1, 0]}, velocity: [0, 30, 0], energies: [{type: particle, density: 1e4}]}\n"},
};

std::string scene(const std::string& objects) {
  return "time: {step: 2 ms, duration: 20 ms}\ngravity: [0, -9.81, 0]\n"
         "objects:\n  - {name: floor, shape: {type: box, size: [0.5, 0.1, 0.5]}, place: {translate: [0, -0.05, 0]}, motion: [fixed]}\n" +
         objects +
         "contact: {distance: 1 mm, friction: {mu: 0.3}}\n"
         "solver: {type: projected_newton, linear: cholmod, tolerance: 1e-8, balance_tolerance: 1e-6}\n";
}

}  // namespace

TEST_CASE("bystanders that cannot meet a body change nothing for it", "[setup]") {
  for (const Kind& base : bases) {
    const auto end = [&](const std::string& more) {
      TestRun s(scene(base.yaml + more));
      for (int i = 0; i < 10; ++i) s.step();
      const Body& body = s.world->bodies[s.world->index_of("it")];
      return std::pair{VecX(s.state().x.segment(3 * body.first_vertex, 3 * body.vertex_count)), used_stiffness(*s.world).barriers.at(0).stiffness};
    };
    const auto [alone, stiffness] = end("");
    for (const Kind& bystander : bystanders) {
      INFO(base.name << " beside " << bystander.name);
      const auto [x, used] = end(bystander.yaml);
      CHECK(used == stiffness);
      CHECK((x - alone).lpNorm<Eigen::Infinity>() < 1e-9);
    }
  }
}

// Control of the test above: bodies that can meet the body do count.
TEST_CASE("a fast body that may hit a soft one stiffens its contact", "[setup]") {
  const auto stiffness = [](double distance) {
    TestRun s(scene(bases[0].yaml + fmt::format("  - {{name: fast, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [{}, 0.1, 0]}}, "
                                                "body: {{type: affine, density: 7800}}, velocity: [-50, 0, 0]}}\n", distance)));
    return used_stiffness(*s.world).barriers.at(0).stiffness;
  };
  CHECK(stiffness(0.5) > 2 * stiffness(50));
}

TEST_CASE("the energy of a fast bystander does not change the energy tolerance of others", "[setup]") {
  const auto reference_energy = [](const std::string& more) {
    TestRun s(scene(bases[0].yaml + more));
    double most = 0;
    for (int i = 0; i < 10; ++i) most = std::max(most, s.step().flows.reference_energy);
    return most;
  };
  const double alone = reference_energy("");
  CHECK(alone > 0.1);  // J: 1 kg at 0.6 m/s
  CHECK(reference_energy(bystanders[2].yaml) == Approx(alone).epsilon(0.01));  // that has 10 J
}

// Without an end, all that moves meets: the duration decides who may meet, and a longer run may find another stiffness.
TEST_CASE("the duration of a run only matters for stiffness through the bodies that meet in it", "[setup]") {
  const std::string away = "  - {name: fast, shape: {type: box, size: [0.01, 0.01, 0.01]}, place: {translate: [50, 0.1, 0]}, body: {type: affine, density: 7800}, velocity: [-50, 0, 0]}\n";
  const auto build = [](const std::string& objects, const char* duration) {
    std::string text = scene(objects);
    text.replace(text.find("20 ms"), 5, duration);
    return TestRun(text);
  };
  const auto stiffness = [](const TestRun& s) { return used_stiffness(*s.world).barriers.at(0).stiffness; };
  const TestRun brief = build(bases[0].yaml + away, "20 ms"), longer = build(bases[0].yaml + away, "2 s");
  CHECK(meeting_names(*brief.world) == std::vector<std::vector<std::string>>{{"it"}, {"fast"}});
  CHECK(meeting_names(*longer.world) == std::vector<std::vector<std::string>>{{"it", "fast"}});
  CHECK(stiffness(longer) > 2 * stiffness(brief));
  CHECK(stiffness(build(bases[0].yaml, "2 s")) == stiffness(build(bases[0].yaml, "20 ms")));
}

// An object hit in one collision is at most twice as fast as the one that hits it.
TEST_CASE("meeting groups allow for the speed after an elastic collision", "[setup]") {
  const auto groups = [](double distance) {
    const TestRun s(scene(bases[1].yaml + fmt::format("  - {{name: fast, shape: {{type: box, size: [0.01, 0.01, 0.01]}}, place: {{translate: [{}, 0.1, 0]}}, "
                                                      "body: {{type: affine, density: 7800}}, velocity: [50, 0, 0]}}\n", distance)));
    return meeting_names(*s.world).size();
  };
  CHECK(groups(1.7) == 1);  // 50 m/s for 20 ms: 1 m, thrown 2 m
  CHECK(groups(3) == 2);
}
