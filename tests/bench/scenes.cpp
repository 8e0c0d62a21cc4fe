#include "tests/bench/scenes.hpp"

#include <fmt/format.h>

#include <random>

#include "framework/contact/contact_system.hpp"
#include "framework/contact/contact_term.hpp"
#include "framework/contact/friction_term.hpp"
#include "framework/scene/build_world.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack::bench {
namespace {

constexpr const char* sheets_text = R"(
name: sheets
objects:
  - {{name: lower, shape: {{type: grid, size: [1, 1], cells: [99, 99]}}}}
  - name: upper
    shape: {{type: grid, size: [1, 1], cells: [99, 99]}}
    place: {{axis: [0, 1, 0], angle: 7 deg, translate: [0, 0.25 mm, 0]}}
contact:
  distance: 1 mm
  weights: {}
  pairs:
    - between: [lower, upper]
{})";
constexpr const char* adhesion_text =
    "      adhesion: {type: fang, peak_traction: 1 kPa, peak_distance: 1 mm, range: 2 mm}\n";

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

// An open sheet as a body of the world; it has no energy, so build_world() would refuse it.
void add_sheet(const ObjectConfig& object, World& world) {
  Mesh mesh = object.shape->make();
  rotate(mesh, object.place.axis, object.place.angle);
  translate(mesh, object.place.translate);
  Body body;
  body.name = object.name;
  body.first_vertex = static_cast<int>(world.rest.size()) / 3;
  body.vertex_count = static_cast<int>(mesh.vertices.size());
  body.triangles = mesh.triangles;
  for (Triangle& t : body.triangles)
    for (int& v : t) v += body.first_vertex;
  world.rest.conservativeResize(world.rest.size() + 3 * body.vertex_count);
  for (int i = 0; i < body.vertex_count; ++i)
    vertex(world.rest, body.first_vertex + i) = mesh.vertices[i];
  world.bodies.push_back(std::move(body));
}

std::unique_ptr<Scene> built(LoadedExperiment loaded) {
  return std::unique_ptr<Scene>(new Scene{std::make_unique<BuiltExperiment>(std::move(loaded)), {}, nullptr});
}

}  // namespace

std::unique_ptr<Scene> sheets(const std::string& weights, Laws laws) {
  const bool adhesive = laws == Laws::barrier_and_adhesion;
  std::unique_ptr<Scene> scene(
      new Scene{nullptr, parse_experiment(fmt::format(sheets_text, weights, adhesive ? adhesion_text : ""), "sheets"),
                std::make_unique<World>()});
  World& world = *scene->world;
  for (const ObjectConfig& object : scene->loaded.experiment.objects) add_sheet(object, world);
  const Eigen::Index n = world.rest.size() / 3;
  world.mass = VecX::Constant(n, 1e-4);
  world.dofs = DofMap(std::vector<char>(static_cast<size_t>(n), 1));
  build_contact(scene->loaded.experiment, scene->loaded.root, scene->clock, world);
  world.terms = {world.contact_term.get()};
  world.contact->begin_step({world.rest});
  world.contact->move_to(world.rest);
  return scene;
}

std::unique_ptr<Scene> plates() {
  auto scene = built(parse_experiment(plates_text, "plates"));
  scene->world->contact->begin_step({scene->world->rest});
  scene->world->contact->move_to(scene->world->rest);
  return scene;
}

LoadedExperiment loaded(const std::string& file, std::vector<std::string> overrides) {
  overrides.emplace_back("output.frames=false");
  return load_experiment(TACK_SOURCE_DIR "/experiments/" + file, overrides);
}

std::unique_ptr<Scene> two_blocks() { return built(loaded("stack/two_blocks.yaml")); }

StepPotential::StepPotential(Scene& scene)
    : world_(*scene.world),
      potential_(world_.terms, world_.dofs, world_.mass, scene.clock,
                 [this](const VecX& x) { if (world_.contact) world_.contact->move_to(x); }) {
  constexpr double h = 0.01;  // s
  if (world_.contact) world_.contact->begin_step({world_.rest});
  potential_.begin_step(world_.rest, world_.rest, {h * h, h * h}, true);
  move_to(world_.rest);
}

void StepPotential::move_to(const VecX& x) {
  VecX q;
  world_.dofs.gather(x, q);
  potential_.move_to(q);
}

VecX random_motion(Eigen::Index vertices, double half_width) {
  std::mt19937 generator(1);
  VecX p(3 * vertices);
  // Not std::uniform_real_distribution, whose results depend on the library.
  for (double& c : p) c = half_width * (2.0 * generator() / double(std::mt19937::max()) - 1.0);
  return p;
}

}  // namespace tack::bench
