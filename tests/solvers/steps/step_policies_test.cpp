// Step policies: what a minimiser makes of its directions, chosen in the scene.
#include <fmt/format.h>

#include <catch2/catch.hpp>

#include "framework/config/bind.hpp"
#include "framework/config/parse.hpp"
#include "framework/run/stored_step.hpp"
#include "framework/stepping/feasible_steps.hpp"
#include "solvers/steps/step_policy.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// Half of the straight step, at first; counts its calls.
class Timid : public StepPolicy {
 public:
  static inline int made_by_others = 0, taken = 0;
  std::optional<MinimizerStatus> advance(const StepContext& context, const VecX& p, VecX& q, std::optional<MadeStep>& made) override {
    if (context.result.iterations > 1) return std::nullopt;
    Objective& objective = context.problem.objective;
    const double before = objective.value(), slope = objective.gradient().dot(p), t = context.problem.feasible_step(q, p) / 2;
    q += t * p;
    objective.move_to(q);
    made.emplace(MadeStep{p, t, 2 * t, 1, slope, before, before - objective.value(), true});
    ++taken;
    return MinimizerStatus::converged;
  }
  void after(const StepContext& context, const MadeStep* made, VecX&) override { made_by_others += made && context.result.iterations > 1; }
};
TACK_REGISTER(StepPolicy, Timid, "timid", "For tests.", "");

StoredSolve solved(const StoredStep& step, const std::string& solver) { return step.solve(parse_string(solver, "(test)")); }

}  // namespace

TEST_CASE("every list of step policies finds the same minimum", "[steps]") {
  for (const char* name : {"impact", "twist", "debonding_front", "contrast"}) {
    INFO(name);
    StoredStep step(std::string(TACK_TEST_DATA "/problems/") + name + ".problem");
    REQUIRE(step.find_minimum());
    for (const char* policies : {"[straight]", "[conjugation, straight]", "[straight, extrapolation]", "[retraction, straight]", "[planes, straight]", "[straight, elimination]", "[conjugation, retraction, straight, elimination, extrapolation]",
                                 "[conjugation, retraction, {type: planes, below: 1}, straight, extrapolation]"}) {
      INFO(policies);
      const StoredSolve result = solved(step, fmt::format("{{step: {}, tolerance: 0.01 mm/s}}", policies));
      CHECK(result.converged);
      REQUIRE(result.distance);
      CHECK(*result.distance < 1e-3);
    }
  }
}

TEST_CASE("the default policies are those that the reference names", "[steps]") {
  const StoredStep step(TACK_TEST_DATA "/problems/twist.problem");
  const StoredSolve own = step.solve({}), named = solved(step, "{step: [conjugation, retraction, straight, extrapolation]}");
  CHECK(own.iterations == named.iterations);
  CHECK(own.x == named.x);
  const StoredSolve plain = solved(step, "{step: [straight]}");
  CHECK(plain.converged);
  CHECK(plain.x != own.x);
}

TEST_CASE("a policy of one's own leaves the others in force", "[steps]") {
  Timid::taken = Timid::made_by_others = 0;
  const StoredSolve result = solved(StoredStep(TACK_TEST_DATA "/problems/twist.problem"), "{step: [conjugation, timid, straight, extrapolation]}");
  CHECK(result.converged);
  CHECK(Timid::taken == 1);
  CHECK(Timid::made_by_others >= result.iterations - 1);
}

TEST_CASE("elimination saves iterations where a step is cut, for any descent method", "[steps]") {
  StoredStep step(TACK_TEST_DATA "/problems/twist.problem");
  REQUIRE(step.find_minimum());
  const int own = step.solve({}).iterations;
  const StoredSolve eliminated = solved(step, "{step: [conjugation, retraction, straight, elimination, extrapolation]}");
  CHECK(eliminated.converged);
  CHECK(eliminated.iterations < own);
  CHECK(eliminated.linear_solves > eliminated.iterations);  // local systems are counted
  for (const char* type : {"newton_pcg", "lbfgs", "nonlinear_cg"}) {
    INFO(type);
    const StoredSolve other = solved(step, fmt::format("{{type: {}, step: [straight, elimination]}}", type));
    CHECK(other.converged);
    REQUIRE(other.distance);
    CHECK(*other.distance < 0.05);
  }
}

TEST_CASE("a list of policies of which none makes every step is refused", "[steps]") {
  const StoredStep step(TACK_TEST_DATA "/problems/twist.problem");
  CHECK_THROWS_WITH(solved(step, "{step: [conjugation, retraction]}"), Catch::Contains("no policy of `step` makes every step; add `straight`"));
  CHECK_THROWS_WITH(solved(step, "{step: [strait]}"), Catch::Contains("straight"));
}

TEST_CASE("step filters act where the solver names them", "[steps][filters]") {
  StepProblem s(
      "objects:\n"
      "  - {name: sheet, shape: {type: grid, size: [0.5, 0.5], cells: [3, 3]}, motion: [fixed]}\n"
      "  - {name: box, shape: {type: box, size: [0.1, 0.1, 0.1]}, place: {translate: [0, 0.06, 0]}, energies: [{type: neo_hookean, young: 1e5}]}\n"
      "contact: {distance: 1 mm}\n");
  VecX fall = VecX::Zero(s.q.size()), crush = fall;
  for (Eigen::Index i = 1; i < fall.size(); i += 3) fall(i) = -1;
  for (Eigen::Index i = 0; i < fall.size(); i += 3) crush(i) = -2 * s.q(i);
  const auto largest = [&](const char* solver, const VecX& p) {
    const auto minimizer = bind_component<Minimizer>(parse_string(solver, "(test)"));
    return FeasibleSteps(*s.world, s.clock, nullptr, minimizer->step_filters()).largest_requested(s.potential, s.q, p);
  };
  CHECK(largest("projected_newton", fall) < 0.1);
  CHECK(largest("projected_newton", crush) < 1);
  CHECK(largest("{type: projected_newton, step_filters: [inversion]}", fall) == 1);
  CHECK(largest("{type: projected_newton, step_filters: [inversion]}", crush) < 1);
  CHECK(largest("{type: projected_newton, step_filters: []}", crush) == 1);
}
