// Equal input gives equal bits for any number of threads.
#include <catch2/catch.hpp>
#include <tbb/global_control.h>

#include "framework/contact/terms/contact_term.hpp"
#include "tests/support/step_problem.hpp"
#include "tests/support/tet_body.hpp"

using namespace tack;

namespace {

// Two boxes, one on the other; enough tets and contacts for many chunks of work.
const char* const boxes =
    "time: {step: 0.01, duration: 1}\n"
    "gravity: [0, -9.81, 0]\n"
    "objects:\n"
    "  - {name: a, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [12, 3, 12]},\n"
    "     energies: [{type: neo_hookean, young: 1e5}], motion: [{type: fixed, select: {type: face, direction: [0, -1, 0]}}]}\n"
    "  - {name: b, shape: {type: box, size: [0.2, 0.1, 0.2], cells: [11, 3, 11]}, place: {translate: [0.013, 0.101, 0.007]},\n"
    "     energies: [{type: fixed_corotated, young: 1e5}]}\n"
    "contact: {distance: 3 mm, pairs: [{between: [a, b], adhesion: {type: fang, critical_strain: 0.01}}]}\n"
    "solver: {type: projected_newton, tolerance: 1e-4}\n";

struct Evaluation {
  double value;
  VecX gradient;
  std::vector<double> hessian;
  std::vector<int> rows;
  int contacts;
};

// Solids whose elements group several tets.
const std::string grouped = [] {
  std::string scene = boxes;
  const auto put = [&](const std::string& before, const std::string& text) { scene.insert(scene.find(before) + before.size(), text); };
  put("cells: [12, 3, 12]},", " elements: composite,");
  put("cells: [11, 3, 11]},", " elements: patches,");
  return scene;
}();

Evaluation evaluate(const std::string& boxes_of, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  StepProblem step(boxes_of);
  RandomMotions random(6);
  step.potential.move_to(step.q + 2e-4 * random.vectors(step.q.size()));
  const BlockMatrix& matrix = step.potential.hessian({Projection::clamp});
  return {step.potential.value(), step.potential.gradient(), matrix.values, matrix.row,
          static_cast<int>(step.world->contact->contacts().size())};
}

VecX simulate(const std::string& boxes_of, int threads) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
  TestScene scene(boxes_of);
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  for (int i = 0; i < 4; ++i) stepper.advance();
  return stepper.state().x;
}

}  // namespace

TEST_CASE("value, gradient and Hessian have the same bits for 1 and 2 threads", "[assembly]") {
  const std::string scene = GENERATE(std::string(boxes), grouped);
  const Evaluation one = evaluate(scene, 1), two = evaluate(scene, 2);
  CHECK(one.contacts > 512);  // more than two chunks
  CHECK(one.contacts == two.contacts);
  CHECK(one.value == two.value);
  CHECK((one.gradient == two.gradient));
  CHECK((one.rows == two.rows));
  CHECK((one.hessian == two.hessian));
}

TEST_CASE("whole time steps have the same bits for 1 and 2 threads", "[assembly]") {
  const std::string scene = GENERATE(std::string(boxes), grouped);
  const VecX one = simulate(scene, 1);
  CHECK((one == simulate(scene, 2)));
  CHECK((one == simulate(scene, 1)));
}
