// Error control of a direction of a solver.
#include "solvers/minimizers/direction_check.hpp"

#include <catch2/catch.hpp>

#include "tests/support/component_variants.hpp"
#include "tests/support/on_floor.hpp"
#include "tests/support/random_blocks.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// A block that hits a floor at 1 m/s: the first Newton direction is 0.225 m/s times the step.
const std::string approaching = step_on_floor(R"(
  - name: block
    shape: {type: box, size: [0.2, 0.2, 0.2], cells: [2, 2, 2]}
    place: {translate: [0, 0.1003, 0]}
    velocity: [0, -1, 0]
    energies: [{type: neo_hookean, young: 1e6, poisson: 0.4, density: 1000}]
contact: {distance: 1 mm}
)");

// Says that it has solved, and gives but a part of the solution.
class Liar : public LinearSolver {
 public:
  explicit Liar(double part) : part_(part) {}
  bool factorize(const BlockMatrix& matrix, PhaseClock& clock) override { return exact_->factorize(matrix, clock); }
  void solve(const VecX& b, VecX& x, PhaseClock& clock) override {
    ++solves;
    exact_->solve(b, x, clock);
    x *= part_;
  }
  int analyses() const override { return 0; }
  int solves = 0;

 private:
  double part_;
  std::unique_ptr<LinearSolver> exact_ = component<LinearSolver>("cholmod");
};

struct Judged {
  double norm = 0;
  VecX p, exact;
  int solves = 0;
};

// Returns the norm for the approximate Newton direction of `linear`, with a tolerance [m/s].
Judged judged(LinearSolver& linear, double tolerance) {
  StepProblem step(approaching);
  const auto minimizer = component<Minimizer>("{type: projected_newton, tolerance: " + std::to_string(tolerance) + "}");
  Convergence convergence = step.convergence(*minimizer);
  MinimizerProblem problem{step.potential, {}, {}, step.clock};
  convergence.set_criteria(problem);
  step.potential.move_to(step.q);
  const BlockMatrix& hessian = step.potential.hessian({Projection::clamp});
  const VecX b = -step.potential.gradient();
  Judged result;
  result.exact = dense(hessian).ldlt().solve(b);
  REQUIRE(linear.factorize(hessian, step.clock));
  linear.solve(b, result.p, step.clock);
  MinimizerResult counts;
  result.norm = DirectionCheck().norm(linear, hessian, problem, result.p, counts);
  result.solves = counts.linear_solves;
  return result;
}

double norm_of(const VecX& p, double tolerance) { return p.lpNorm<Eigen::Infinity>() / 0.01 / tolerance; }

}  // namespace

TEST_CASE("a wrong direction of a solver is detected", "[minimizer]") {
  for (const double part : {1e-9, 1e-3, 0.3}) {
    INFO("the part of the direction that it gives: " << part);
    Liar liar(part);
    const Judged j = judged(liar, 0.2);
    CHECK(norm_of(j.exact, 0.2) > 1);
    CHECK(j.norm > 1);
  }
}

TEST_CASE("terms that a solver omits are added", "[minimizer]") {
  Liar liar(0.9);  // a tenth is left each time
  const Judged j = judged(liar, 0.3);
  CHECK(j.norm <= 1);
  CHECK(j.norm >= norm_of(j.exact, 0.3));
  CHECK(j.solves > 0);
  CHECK((j.p - j.exact).norm() < 0.1 * j.exact.norm());
}

TEST_CASE("the stopping norm of a direction is never below that of the exact direction", "[minimizer]") {
  for (const char* yaml : {"cholmod", "auto", "{type: lagged_cholesky, tolerance: 0.5}", "{type: pcg, tolerance: 0.5}",
                           "{type: pcg, preconditioner: block_jacobi, tolerance: 0.3}",
                           "{type: pcg, preconditioner: block_jacobi, tolerance: 0.5, truncate: true, max_iterations: 1}"})
    for (const double tolerance : {0.1, 0.2, 0.22, 0.23, 0.3, 3.0}) {
      INFO(yaml << ", tolerance " << tolerance);
      const auto linear = component<LinearSolver>(yaml);
      const Judged j = judged(*linear, tolerance);
      const double exact = norm_of(j.exact, tolerance);
      if (j.norm <= 1) CHECK(j.norm >= exact * (1 - 1e-9));
      if (exact > 1) CHECK(j.norm > 1);
      if (std::string(yaml) == "cholmod") {
        CHECK(j.norm == Approx(exact).epsilon(1e-6));
        CHECK(j.solves == 0);  // one look is all that it takes
      }
    }
}
