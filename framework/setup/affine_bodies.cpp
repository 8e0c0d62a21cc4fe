#include "framework/setup/affine_bodies.hpp"

#include <fmt/format.h>

#include <cmath>
#include <map>

#include "framework/affine/frame.hpp"
#include "framework/affine/orthogonality_term.hpp"
#include "framework/body/extent.hpp"
#include "framework/body/local_mesh.hpp"
#include "framework/setup/build_world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class Affine : public BodyModel {
 public:
  void fields(Fields& f) override {
    f.number("density", density_, units::density, "mass per volume").positive();
    f.optional_number("stiffness", stiffness_, units::pressure,
                      "stress per strain; unless given, high enough for strains below 1e-4 under the weight of everything that it "
                      "may touch in the run, and if it is stopped within a step at the speed of a fall over the extent of all that")
        .positive();
  }
  double density() const override { return density_; }
  std::optional<double> stiffness() const override { return stiffness_; }

 private:
  double density_ = 1000;            // kg/m^3
  std::optional<double> stiffness_;  // Pa
};

TACK_REGISTER(BodyModel, Affine, "affine",
              "Affine, nearly rigid body: twelve degrees of freedom for any mesh, with exact mass and second moments.",
              "Lan, Kaufman, Li, Jiang, Yang 2022, Affine Body Dynamics");

}  // namespace

void add_frame(const ObjectConfig& object, int index, World& world) {
  Body& body = world.bodies[index];
  if (!object.energies.empty())
    throw InputError(fmt::format("object '{}' is an affine body and has energies, which would never strain; give "
                                 "body.density, and take the energies or `body` away", object.name));
  try {
    const MassProperties properties = mass_properties(local_mesh(body, world.rest));
    const BodyFrame frame = body_frame(properties);
    body.volume = properties.volume;
    body.frame = Unknowns(world, body.name, index).add_vector_dofs("frame", frame.vertices);
    AffineFrame binding{{body.frame[0], body.frame[1], body.frame[2], body.frame[3]}, {}};
    for (int v = body.first_vertex; v < body.first_vertex + body.vertex_count; ++v)
      binding.dependents.push_back({v, frame.weights(vertex(world.rest, v))});
    world.constraints.add(std::move(binding));
  } catch (const InputError& error) {
    throw InputError(fmt::format("object '{}' (body: affine) {}", object.name, error.what()));
  }
}

double default_stiffness(const ObjectConfig& object, const Body& body, const Loading& loading, const VecX& rest, double step) {
  Vec3 size = extent_of(body, rest).sizes();
  std::sort(size.begin(), size.end());
  const double stress = loading.weight / (size(0) * size(1)) + object.body->density() * size(2) * loading.speed / step;
  constexpr double least = 1e6;  // [Pa], for bodies that nothing pushes
  return std::max(least, stress / tolerated_affine_strain);
}

void add_affine_masses(const ObjectConfig& object, int index, World& world) {
  const Body& body = world.bodies[index];
  for (const int v : body.frame) world.mass(v) = object.body->density() * body.volume / 4;
}

void add_affine_terms(const SceneConfig& scene, const Value& root, const RunTimes& times, World& world) {
  auto term = std::make_unique<OrthogonalityTerm>();
  const std::vector<Loading> loading = loadings(scene, world, times.duration);
  // Copies of one entry (fill) get the stiffness of the stiffest, whatever their orientation.
  std::map<std::string, double> of_entry;
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    Body& body = world.bodies[i];
    if (body.frame.empty() || !body.movable) continue;
    body.stiffness = scene.objects[i].body->stiffness().value_or(0);
    if (body.stiffness == 0) body.stiffness = default_stiffness(scene.objects[i], body, loading[i], world.rest, times.step);
    double& stiffest = of_entry[source_location(root, "objects", i)];
    stiffest = std::max(stiffest, body.stiffness);
  }
  for (size_t i = 0; i < world.bodies.size(); ++i) {
    Body& body = world.bodies[i];
    if (body.frame.empty() || !body.movable) continue;
    const Tet frame = {body.frame[0], body.frame[1], body.frame[2], body.frame[3]};
    if (const std::string entry = source_location(root, "objects", i); !entry.empty()) body.stiffness = of_entry[entry];
    term->add(frame, world.rest, body.volume, body.stiffness);
    world.tets.push_back(frame);
  }
  if (term->empty()) return;
  world.affine = term.get();
  world.elastic_terms.push_back(std::move(term));
}

}  // namespace tack
