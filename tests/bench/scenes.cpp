#include "tests/bench/scenes.hpp"

#include <fmt/format.h>

#include <random>

#include "framework/scene/energy.hpp"

namespace tack::bench {
namespace {

constexpr const char* sheets_text = R"(
name: sheets
objects:
  - {{name: lower, shape: {{type: grid, size: [1, 1], cells: [99, 99]}}, energies: [bench_mass]}}
  - name: upper
    shape: {{type: grid, size: [1, 1], cells: [99, 99]}}
    energies: [bench_mass]
    place: {{axis: [0, 1, 0], angle: 7 deg, translate: [0, 0.25 mm, 0]}}
contact:
  distance: 1 mm
  weights: {}
  pairs:
    - between: [lower, upper]
{})";
constexpr const char* adhesion_text =
    "      adhesion: {type: fang, peak_traction: 1 kPa, peak_distance: 1 mm, range: 2 mm}\n";
constexpr const char* bonds_text =
    "      adhesion: {type: rcc, normal_stiffness: 1e7 Pa/m, tangential_stiffness: 5e6 Pa/m, work_of_adhesion: 0.1 J/m^2}\n";

constexpr const char* plates_text = R"(
name: plates
time: {step: 0.01 s, duration: 1 s}
objects:
  - name: lower
    shape: {type: box, size: [1, 0.01, 1], cells: [75, 1, 75]}
    motion: [fixed]
  - name: middle
    shape: {type: box, size: [1, 0.01, 1], cells: [75, 1, 75]}
    place: {axis: [0, 1, 0], angle: 7 deg, translate: [0, 10.25 mm, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.4, density: 1000}]
  - name: upper
    shape: {type: box, size: [1, 0.01, 1], cells: [75, 1, 75]}
    place: {axis: [0, 1, 0], angle: 14 deg, translate: [0, 20.5 mm, 0]}
    energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.4, density: 1000}]
contact: {distance: 1 mm, friction: {mu: 0.5, eps_v: 1 cm/s}}
)";

// Mass without stiffness: build_world() refuses movable bodies without energies.
class Mass : public Energy {
 public:
  std::unique_ptr<Term> make_term(const Body&, const VecX&) const override { return std::make_unique<Nothing>(); }
  void add_mass(const Body& body, const VecX&, VecX& mass) const override {
    mass.segment(body.first_vertex, body.vertex_count).setConstant(1e-4);
  }

 private:
  struct Nothing : Term {
    Nothing() : Term("nothing") {}
    double value(const VecX&) const override { return 0; }
  };
};

TACK_REGISTER(Energy, Mass, "bench_mass", "0.1 g per vertex.", "benchmarks");

}  // namespace

Scene::Scene(LoadedExperiment loaded)
    : simulation(std::move(loaded)), step((simulation.start(), simulation.stepper().open(simulation.experiment().time.step))) {
  move_to(step.state.x);
}

void Scene::move_to(const VecX& x) {
  VecX q;
  world->dofs.gather(x, q);
  potential.move_to(q);
}

std::unique_ptr<Scene> sheets(const std::string& weights, Laws laws) {
  const char* adhesion = laws == Laws::barrier_and_adhesion ? adhesion_text : laws == Laws::barrier_and_bonds ? bonds_text : "";
  return std::make_unique<Scene>(parse_experiment(fmt::format(sheets_text, weights, adhesion), "sheets"));
}

std::unique_ptr<Scene> plates() { return std::make_unique<Scene>(parse_experiment(plates_text, "plates")); }

LoadedExperiment loaded(const std::string& file, std::vector<std::string> overrides) {
  overrides.emplace_back("output.frames=false");
  return load_experiment(TACK_SOURCE_DIR "/experiments/" + file, overrides);
}

std::unique_ptr<Scene> two_blocks() { return std::make_unique<Scene>(loaded("stack/two_blocks.yaml")); }

VecX random_motion(Eigen::Index vertices, double half_width) {
  std::mt19937 generator(1);
  VecX p(3 * vertices);
  // Results of std::uniform_real_distribution depend on the library.
  for (double& c : p) c = half_width * (2.0 * generator() / double(std::mt19937::max()) - 1.0);
  return p;
}

}  // namespace tack::bench
