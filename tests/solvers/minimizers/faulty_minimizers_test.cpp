// Minimisers with the mistakes of beginners: a run says which one was made, and in which step.
#include <catch2/catch.hpp>
#include <cmath>
#include <stdexcept>

#include "framework/experiment/load_experiment.hpp"
#include "framework/run/simulation.hpp"
#include "geometry/errors.hpp"
#include "solvers/minimizers/descent_minimizer.hpp"
#include "tests/support/tiny_scene.hpp"

using namespace tack;
using Catch::Contains;

namespace {

enum class Mistake { throws, throws_a_number, not_finite, uphill, zero, short_direction };

class Faulty : public DescentMinimizer {
 public:
  explicit Faulty(Mistake mistake) : mistake_(mistake) {}

 protected:
  MinimizerStatus direction(const MinimizerProblem& problem, VecX& p, MinimizerResult&) override {
    const VecX& g = problem.objective.gradient();
    switch (mistake_) {
      case Mistake::throws: throw std::runtime_error("my matrix is singular");
      case Mistake::throws_a_number: throw 42;
      case Mistake::not_finite: p = std::nan("") * g; break;
      case Mistake::uphill: p = g; break;
      case Mistake::zero: p = VecX::Zero(g.size()); break;
      case Mistake::short_direction: p = -g.head(g.size() - 3); break;
    }
    return MinimizerStatus::converged;
  }

 private:
  Mistake mistake_;
};

// Returns the error of the first step. Without substeps: in short ones the first guess converges.
std::string error_with(Mistake mistake) {
  const std::string scene = tiny_scene_with("duration: 0.05 s", "duration: 0.05 s, max_cutbacks: 0");
  Simulation simulation(parse_experiment(scene, "tiny.yaml", {}));
  simulation.solve_with([mistake] { return std::make_unique<Faulty>(mistake); });
  simulation.start();
  try {
    simulation.step();
  } catch (const SimulationError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("mistakes of minimisers are named, with the step", "[minimizer]") {
  CHECK_THAT(error_with(Mistake::throws),
             Contains("step 1 at t = 0 s: the minimizer failed: my matrix is singular"));
  CHECK_THAT(
      error_with(Mistake::throws_a_number),
      Contains("step 1 at t = 0 s: the minimizer failed: it threw what is no std::exception"));
  CHECK_THAT(error_with(Mistake::not_finite), Contains("step 1 ") && Contains("is not finite") &&
                                                  Contains("correct the method") &&
                                                  !Contains("time step"));
  CHECK_THAT(error_with(Mistake::uphill), Contains("is no descent direction"));
  CHECK_THAT(error_with(Mistake::zero), Contains("is no descent direction"));
  CHECK_THAT(error_with(Mistake::short_direction),
             Contains("step 1 ") && Contains("entries, and the problem has"));
}
