// A free spinning body with stiffness-proportional damping: spin and angular momentum are
// conserved.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/core/damping_terms.hpp"
#include "framework/core/term_gradient.hpp"
#include "tests/support/dense_term.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

double angular_momentum(const TestRun& run) {
  Vec3 sum = Vec3::Zero();
  for (int v = 0; v < run.world->mass.size(); ++v) sum += run.world->mass(v) * Vec3(vertex(run.state().x, v)).cross(Vec3(vertex(run.state().v, v)));
  return sum.norm();
}
double kinetic_energy(const TestRun& run) {
  double sum = 0;
  for (int v = 0; v < run.world->mass.size(); ++v) sum += run.world->mass(v) / 2 * vertex(run.state().v, v).squaredNorm();
  return sum;
}
// Returns the moment of the damping forces in the last step [N m].
double damping_moment(const TestRun& run) {
  VecX gradient = VecX::Zero(run.state().x.size());
  for (const auto& term : run.world->damping_terms) add_term_gradient(*term, run.state().x, gradient);
  return total_moment(run.state().x, gradient).norm();
}

}  // namespace

TEST_CASE("stiffness damping conserves the angular momentum of a freely spinning body", "[damping]") {
  const std::string bar = "shape: {type: box, size: [0.1, 0.02, 0.02], cells: [5, 1, 1]}, energies: [{type: neo_hookean, young: 1 MPa, poisson: 0.3, density: 1000}]";
  const std::string card = "shape: {type: grid, size: [0.1, 0.03], cells: [5, 2]}, place: {axis: [1, 0, 0], angle: 90 deg}, shell: {thickness: 1 mm},\n"
                           "  energies: [{type: stvk_membrane, young: 10 MPa, density: 1000}, {type: hinge_bending, young: 10 MPa}]";
  for (const std::string integrator : {"implicit_euler", "bdf2", "newmark", "generalised_alpha", "tr_bdf2"})
    for (const std::string& object : {bar, card}) {
      INFO(integrator << ", " << object);
      TestRun run(fmt::format("time: {{step: 0.5 ms, duration: 1, integrator: {}}}\nsolver: {{type: projected_newton, tolerance: 1e-9, force_floor: 1e-12}}\n"
                           "objects: [{{name: it, {}, spin: [0, 0, 60], damping: {{stiffness: 1 ms}}}}]\n", integrator, object));
      const double momentum = angular_momentum(run), energy = kinetic_energy(run);
      double taken = 0;
      for (int i = 0; i < 100; ++i) {
        run.step();
        taken += run.config.time.step * damping_moment(run);
      }
      CHECK(taken <= 1e-8 * momentum);
      // The tolerances leave room for the losses of the integrator and for stretching.
      const bool damps = integrator == "implicit_euler";
      CHECK(angular_momentum(run) == Approx(momentum).epsilon(damps ? 0.1 : 4e-3));
      CHECK(kinetic_energy(run) == Approx(energy).epsilon(damps ? 0.2 : 0.02));
    }
}
