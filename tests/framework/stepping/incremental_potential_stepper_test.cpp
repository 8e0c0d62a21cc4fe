// Validations of the incremental-potential stepper: which solve results may be accepted, and the
// faults of the others.
#include <catch2/catch.hpp>
#include <fmt/format.h>

#include "framework/stepping/stepper.hpp"
#include "tests/support/component_variants.hpp"
#include "tests/support/step_problem.hpp"

using namespace tack;

namespace {

// Two blocks, 0.2 m apart.
std::string scene(const std::string& solver = "projected_newton", double speed = 0) {
  return fmt::format("time: {{step: 0.01, duration: 1}}\nsolver: {}\n"
                     "objects:\n"
                     "  - {{name: a, shape: {{type: box, size: [0.1, 0.1, 0.1]}}, velocity: [{}, 0, 0], energies: [{{type: neo_hookean, young: 1e6, density: 1000}}]}}\n"
                     "  - {{name: b, shape: {{type: box, size: [0.1, 0.1, 0.1]}}, place: {{translate: [0.3, 0, 0]}}, energies: [{{type: neo_hookean, young: 1e6, density: 1000}}]}}\n"
                     "contact: {{distance: 1 mm}}\n",
                     solver, speed);
}

struct Judged : StepProblem {
  explicit Judged(const std::string& yaml) : StepProblem(yaml) {
    stepper_->prepare({*world, config, config.time, *solver, clock});
    stepper_->begin(true);
    result.x = step.targets;
    stepper_->solve(step, nullptr, result);
  }
  // Returns the result of a converged solve that ends at x.
  Validation at(const VecX& x) {
    result.minimizer.status = MinimizerStatus::converged;
    result.x = x;
    world->participants.move_to(x);
    return stepper_->validate(result);
  }
  VecX shifted(int body, const Vec3& by) const {
    VecX x = step.state.x;
    for (const int v : world->vertices_of(body)) vertex(x, v) += by;
    return x;
  }

  const std::unique_ptr<Stepper> stepper_ = component<Stepper>("{type: incremental_potential}");
  SolveResult result{};
};

bool is_power_of_two(int n) { return n > 0 && (n & (n - 1)) == 0; }

}  // namespace

TEST_CASE("a converged solve without a fault may be accepted", "[stepping][stepper]") {
  Judged judged(scene());
  CHECK(judged.result.minimizer.status == MinimizerStatus::converged);
  const Validation validation = judged.stepper_->validate(judged.result);
  CHECK(validation.fault.empty());
  CHECK(validation.intersections == 0);
  CHECK(validation.inverted_tets == 0);
  CHECK_FALSE(validation.tolerable);
}

TEST_CASE("a solve that did not converge is rejected with its status, iterations and residual", "[stepping][stepper]") {
  Judged judged(scene());
  judged.result.minimizer.iterations = 17;
  judged.result.minimizer.residual = 3.25;
  for (const MinimizerStatus status : {MinimizerStatus::iteration_limit, MinimizerStatus::line_search_failed, MinimizerStatus::blocked, MinimizerStatus::factorization_failed,
                                       MinimizerStatus::not_finite}) {
    judged.result.minimizer.status = status;
    const Validation validation = judged.stepper_->validate(judged.result);
    CHECK_THAT(validation.fault, Catch::StartsWith(std::string(to_string(status))) && Catch::Contains("17 iterations") && Catch::Contains("3.25 times the tolerance"));
    CHECK_THAT(validation.remedy, Catch::Contains("solver.max_iterations"));
    CHECK_FALSE(validation.tolerable);
    CHECK(validation.substeps == 2);
  }
}

TEST_CASE("a failure to move prescribed vertices is rejected with its message, for any status", "[stepping][stepper]") {
  Judged judged(scene());
  judged.result.failure = "the plate is in the way";
  for (const MinimizerStatus status : {MinimizerStatus::converged, MinimizerStatus::blocked}) {
    judged.result.minimizer.status = status;
    const Validation validation = judged.stepper_->validate(judged.result);
    CHECK_THAT(validation.fault, Catch::StartsWith("the plate is in the way"));
    CHECK(validation.remedy.find("solver.max_iterations") == std::string::npos);
  }
}

TEST_CASE("a result with an inverted tet is rejected, and names it", "[stepping][stepper]") {
  Judged judged(scene());
  VecX x = judged.step.state.x;
  const Tet& tet = judged.world->tets[3];
  const Vec3 base = vertex(x, tet[0]), n = Vec3(vertex(x, tet[1]) - base).cross(Vec3(vertex(x, tet[2]) - base));
  vertex(x, tet[3]) -= 2 * n.dot(Vec3(vertex(x, tet[3])) - base) / n.squaredNorm() * n;  // its mirror image
  const Validation validation = judged.at(x);
  CHECK(validation.inverted_tets == 1);
  CHECK_THAT(validation.fault, Catch::Contains("inverted"));
}

TEST_CASE("a result whose surfaces intersect is rejected", "[stepping][stepper]") {
  Judged judged(scene());
  const Validation validation = judged.at(judged.shifted(0, {0.25, 0.013, 0.017}));
  CHECK(validation.intersections == 1);
  CHECK_THAT(validation.fault, Catch::Contains("intersect"));
  CHECK_FALSE(validation.tolerable);
}

TEST_CASE("a result in which a body has tunnelled is rejected, or accepted with a warning at the smallest step size", "[stepping][stepper]") {
  Judged judged(scene());
  for (const double motion : {0.6, 1.3, 5.0}) {
    const Validation validation = judged.at(judged.shifted(0, {motion, 0.013, 0.017}));
    INFO(motion);
    CHECK_THAT(validation.fault, Catch::Contains("'a' tunnelled through 'b'"));
    CHECK(validation.intersections == 0);
    CHECK(validation.tolerable);
    // With this number of substeps, none is longer than half of the side of the block.
    CHECK(is_power_of_two(validation.substeps));
    CHECK(motion / validation.substeps <= 0.05 * (1 + 1e-9));
    CHECK(motion / (validation.substeps / 2) > 0.05);
  }
}

TEST_CASE("results with bodies that pass beside each other, or move together, are accepted", "[stepping][stepper]") {
  Judged judged(scene());
  CHECK(judged.at(judged.shifted(0, {0.6, 0.5, 0})).fault.empty());
  CHECK(judged.at(judged.shifted(0, {-3, 0, 0})).fault.empty());
  VecX together = judged.step.state.x;
  for (int v = 0; v < together.size() / 3; ++v) vertex(together, v) += Vec3(7, 1, 2);
  CHECK(judged.at(together).fault.empty());
}

TEST_CASE("a first guess is the inertial motion, from which a free body converges at once", "[stepping][stepper]") {
  const Judged rest(scene()), moving(scene("projected_newton", 0.5));
  for (const int v : moving.world->vertices_of(0)) CHECK((vertex(moving.result.x, v) - vertex(moving.step.state.x, v) - Vec3(0.005, 0, 0)).norm() < 1e-9);
  CHECK(moving.result.minimizer.iterations <= rest.result.minimizer.iterations + 1);
}

TEST_CASE("a minimisation without iterations is rejected by its limit", "[stepping][stepper]") {
  // The blocks meet in this step.
  Judged judged(scene("{type: projected_newton, max_iterations: 1}", 30));
  CHECK(judged.result.minimizer.status == MinimizerStatus::iteration_limit);
  CHECK_THAT(judged.stepper_->validate(judged.result).fault, Catch::Contains("1 iterations") || Catch::Contains("1 iteration"));
}
