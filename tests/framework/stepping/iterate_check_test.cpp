// solver.check_iterates: no iterate intersects or inverts, and one that does is reported.
#include "framework/stepping/iterate_check.hpp"

#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/contact/contact_system.hpp"
#include "framework/stepping/time_stepper.hpp"
#include "geometry/errors.hpp"
#include "tests/support/scene.hpp"
#include "tests/support/test_run.hpp"

using namespace tack;

namespace {

// A block above a fixed plate.
std::string drop(const std::string& solver) {
  return "time: {step: 0.01, duration: 0.01}\n"
         "solver: " + solver + "\n"
         "objects:\n"
         "  - {name: plate, shape: {type: box, size: [1, 0.02, 1]}, place: {translate: [0, -0.01, 0]}, motion: [fixed]}\n"
         "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.1, 0]},\n"
         "     velocity: [0, -1, 0], energies: [{type: neo_hookean, young: 1e6}]}\n"
         "contact: {distance: 1 mm}\n";
}

// A minimiser that visits a given state and returns.
class Excursion : public Minimizer {
 public:
  explicit Excursion(std::function<VecX(const VecX&)> to) : to_(std::move(to)) {}
  MinimizerResult minimize(const MinimizerProblem& problem, VecX& q) override {
    const VecX nowhere = VecX::Zero(q.size());
    problem.feasible_step(q, nowhere);
    problem.feasible_step(to_(q), nowhere);
    problem.feasible_step(q, nowhere);
    return {};
  }

 private:
  std::function<VecX(const VecX&)> to_;
};

}  // namespace

TEST_CASE("an iterate that intersects or inverts ends the run, and is located", "[iterates]") {
  const auto step_with = [](const std::string& check, const std::function<VecX(const VecX&)>& to) {
    TestScene scene(drop("projected_newton"));
    auto solver = std::make_unique<Excursion>(to);
    bind(parse_string("{check_iterates: " + check + "}", "test.yaml"), *solver, "solver");
    TimeStepper stepper(*scene.world, scene.config, scene.config.time, *solver, scene.clock, [](const std::string&) {});
    stepper.advance();
  };
  const auto into_the_plate = [](const VecX& q) {
    VecX lower = q;
    for (int y = 1; y < q.size(); y += 3) lower(y) -= 0.06;
    return lower;
  };
  const auto inside_out = [](const VecX& q) -> VecX { return -q + 2 * VecX::Constant(q.size(), 0.2); };
  const auto nowhere = [](const VecX& q) { return q; };
  CHECK_NOTHROW(step_with("true", nowhere));
  CHECK_NOTHROW(step_with("false", into_the_plate));  // the end of the step is feasible
  CHECK_THROWS_WITH(step_with("true", into_the_plate),
                    Catch::Contains("step 1, iteration 1 of the minimisation: edge (") &&
                        Catch::Contains("'block'") && Catch::Contains(" meets triangle (") &&
                        Catch::Contains("'plate'") && Catch::EndsWith(found_by_iterate_check));
  CHECK_THROWS_WITH(step_with("true", inside_out), Catch::Contains("iteration 1 of the minimisation: tet (") &&
                                                       Catch::Contains("of 'block' is inverted"));
  CHECK_THROWS_AS(step_with("true", inside_out), SimulationError);
}

TEST_CASE("a first guess that intersects is reported", "[iterates]") {
  TestScene scene(drop("{type: projected_newton, check_iterates: true}"));
  TimeStepper stepper(*scene.world, scene.config, scene.config.time, *scene.solver, scene.clock, [](const std::string&) {});
  VecX guess = scene.world->start.x;
  for (int b = 0; b < scene.world->dofs.block_count(); ++b) vertex(guess, scene.world->dofs.vertex_of_block(b)).y() -= 0.06;
  CHECK_THROWS_WITH(stepper.solve(0.01, &guess), Catch::Contains("step 1, iteration 0 of the minimisation"));
}

TEST_CASE("no minimiser passes through an obstacle", "[iterates]") {
  // A block that is shot at a plate, and a plate whose displacement exceeds its distance to the block.
  const std::string shot =
      "objects:\n"
      "  - {name: plate, shape: {type: box, size: [1, 0.004, 1]}, place: {translate: [0, -0.002, 0]}, motion: [fixed]}\n"
      "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]},\n"
      "     place: {axis: [0.3, 0.1, 1], angle: 0.3, translate: [0, 0.12, 0]}, velocity: [3, -40, 1],\n"
      "     energies: [{type: neo_hookean, young: 1e6, poisson: 0.3}]}\n";
  const std::string driven =
      "objects:\n"
      "  - {name: plate, shape: {type: box, size: [0.2, 0.02, 0.2], cells: [2, 1, 2]}, place: {translate: [0, -0.062, 0]},\n"
      "     motion: [{type: translate, velocity: [0.2, 3, 0]}]}\n"
      "  - {name: block, shape: {type: box, size: [0.1, 0.1, 0.1]},\n"
      "     energies: [{type: neo_hookean, young: 1e6}]}\n";
  for (const std::string& type : Registry<Minimizer>::kind().names()) {
    for (const std::string& objects : {shot, driven}) {
      INFO(type);
      TestRun run("time: {step: 0.01, duration: 0.01, max_cutbacks: 0}\n"
                     "solver: {type: " + type + ", max_iterations: 150, check_iterates: true}\n" + objects +
                     "contact: {distance: 1 mm}\n");
      std::string error;
      try {
        run.step();
      } catch (const SimulationError& e) {
        error = e.what();  // slow methods may need more iterations
      }
      INFO(error);
      CHECK(error.find(found_by_iterate_check) == error.npos);
    }
  }
}

TEST_CASE("no prescribed motion passes through an obstacle", "[iterates]") {
  // A free block in the middle has to move if it is in the path.
  const auto paddle = [](const std::string& size, const std::string& cells, const std::string& motion) {
    return "  - {name: paddle, shape: {type: box, size: [" + size + "], cells: [" + cells +
           "]}, place: {translate: [0.12, 0.003, 0.002]}, motion: [" + motion + "]}\n";
  };
  const std::string half_turns = "{type: rotate, axis: [0, 0, 1], angular_velocity: 314.159265358979}";
  const std::string through = "{type: translate, velocity: [-24, 0, 0]}";
  const std::string frames = "{type: keyframes, frames: [{time: 0}, {time: 0.01, translation: [-0.24, 0, 0], "
                             "rotation: [0, 3.14159, 0]}, {time: 0.02}]}";
  const std::string formula = "{type: formula, x: '-24 * t * (1 + 5 * Y)', y: '2 * t * Z'}";
  struct Sweep {
    std::string paddle;
    int block_cells;
  };
  const std::vector<Sweep> sweeps = {
      {paddle("0.02, 0.06, 0.06", "1, 6, 6", half_turns), 2}, {paddle("0.06, 0.06, 0.06", "4, 4, 4", half_turns), 2},
      {paddle("0.1, 0.01, 0.1", "8, 1, 8", half_turns), 2},   {paddle("0.1, 0.01, 0.1", "8, 1, 8", half_turns), 4},
      {paddle("0.02, 0.06, 0.06", "1, 3, 3", through), 2},    {paddle("0.02, 0.06, 0.06", "1, 3, 3", frames), 2},
      {paddle("0.06, 0.06, 0.06", "4, 4, 4", formula), 2}};
  for (const Sweep& sweep : sweeps) {
    INFO(sweep.paddle);
    TestRun run("time: {step: 0.01, duration: 0.02}\n"
                   "solver: {type: projected_newton, check_iterates: true}\nobjects:\n" + sweep.paddle +
                   fmt::format("  - {{name: block, shape: {{type: box, size: [0.1, 0.1, 0.1], cells: [{0}, {0}, {0}]}},\n"
                               "     energies: [{{type: neo_hookean, young: 1e5}}]}}\n", sweep.block_cells) +
                   "contact: {distance: 1 mm}\n");
    CHECK_NOTHROW(run.step());
    CHECK_NOTHROW(run.step());
  }
}
