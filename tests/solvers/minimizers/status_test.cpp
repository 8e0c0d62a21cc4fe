// Every status that a minimizer of ours may end with, provoked on a function of three unknowns.
#include <catch2/catch.hpp>
#include <cmath>
#include <limits>

#include "framework/core/interrupt.hpp"
#include "framework/core/minimizer.hpp"
#include "tests/support/component_variants.hpp"

using namespace tack;

namespace {

// sum of c(x_i) with slope and curvature as given.
struct Curve {
  double (*value)(double);
  double (*slope)(double);
  double (*curvature)(double);
};

class Separable : public Objective {
 public:
  explicit Separable(const Curve& curve) : curve_(curve) {
    matrix_.column_start = {0, 1};
    matrix_.row = {0};
    matrix_.values.assign(9, 0.0);
    matrix_.version = 1;
  }
  int size() const override { return 3; }
  void move_to(const VecX& q) override { q_ = q; }
  double value() override {
    ++count_;
    return curve_.value(q_(0)) + curve_.value(q_(1)) + curve_.value(q_(2));
  }
  double value_noise() const override { return 0; }
  const VecX& gradient() override { return gradient_ = q_.unaryExpr(curve_.slope); }
  const BlockMatrix& hessian(SpdFilter) override {
    gradient();
    matrix_.block(0) = Vec3(q_.unaryExpr(curve_.curvature)).asDiagonal();
    return matrix_;
  }
  int value_count() const override { return count_; }

 private:
  Curve curve_;
  VecX q_, gradient_;
  BlockMatrix matrix_;
  int count_ = 0;
};

const Curve bowl = {[](double x) { return std::cosh(x); }, [](double x) { return std::sinh(x); },
                    [](double x) { return std::cosh(x); }};

struct Ended {
  MinimizerResult result;
  VecX q;
  int values;
};

Ended minimize(const std::string& type, const Curve& curve, double feasible = 1, int max_iterations = 300,
               const Vec3& start = {1, 2, 3}) {
  Separable objective(curve);
  PhaseClock clock;
  const auto minimizer =
      component<Minimizer>("{type: " + type + ", max_iterations: " + std::to_string(max_iterations) + "}");
  VecX q = start;
  const MinimizerResult result = minimizer->minimize(
      {objective, [&](const VecX&, const VecX&) { return feasible; },
       [](const VecX& p, const VecX&) { return p.lpNorm<Eigen::Infinity>() / 1e-6; }, clock},
      q);
  return {result, q, objective.value_count()};
}

const std::vector<std::string> ours = {"projected_newton", "lbfgs", "nonlinear_cg", "gradient_descent", "heavy_ball"};

}  // namespace

TEST_CASE("statuses of minimizers", "[minimizer]") {
  const std::string type = GENERATE(from_range(ours));
  INFO(type);
  SECTION("converged") {
    const Ended e = minimize(type, bowl);
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK(e.result.residual <= 1);
    CHECK(e.q.norm() < 1e-5);
  }
  SECTION("iteration limit reached, with the budget kept") {
    const Ended e = minimize(type, bowl, 1, 2);
    CHECK(e.result.status == MinimizerStatus::iteration_limit);
    CHECK(e.result.iterations == 2);
    CHECK(e.values <= 20);
    CHECK(e.q.norm() < Vec3(1, 2, 3).norm());  // what was gained is kept
  }
  SECTION("line search failed: the slope lies") {
    const Curve liar = {[](double x) { return x; }, [](double) { return -1.0; }, [](double) { return 1.0; }};
    const Ended e = minimize(type, liar);
    CHECK(e.result.status == MinimizerStatus::line_search_failed);
    CHECK(e.q == Vec3(1, 2, 3));
  }
  SECTION("blocked: no step is feasible") {
    CHECK(minimize(type, bowl, 0).result.status == MinimizerStatus::blocked);
  }
  SECTION("factorization failed") {
    const Curve broken = {bowl.value, bowl.slope, [](double) { return std::nan(""); }};
    CHECK(minimize(type, broken).result.status == MinimizerStatus::factorization_failed);
  }
  SECTION("not finite") {
    const Curve broken = {bowl.value, [](double) { return std::nan(""); }, bowl.curvature};
    CHECK(minimize(type, broken).result.status == MinimizerStatus::not_finite);
  }
  SECTION("interrupted") {
    interrupt_requested = true;
    const Ended e = minimize(type, bowl);
    interrupt_requested = false;
    CHECK(e.result.status == MinimizerStatus::interrupted);
    CHECK(e.q == Vec3(1, 2, 3));
  }
}

// A shifted system gives a short step wherever it is taken: short steps are no proof of a minimum.
TEST_CASE("an indefinite Hessian leads on to a minimum, not to a claim of one", "[minimizer]") {
  const Curve wells = {[](double x) { return x * x * (x * x / 4 - 0.5); }, [](double x) { return x * (x * x - 1); },
                       [](double x) { return 3 * x * x - 1; }};
  for (const char* filter : {"none", "clamp", "absolute", "on_demand", "progressive", "adaptive"}) {
    INFO(filter);
    const Ended e = minimize(std::string("projected_newton, filter: ") + filter, wells, 1, 300, Vec3(1e-7, 1e-7, 1e-7));
    CHECK(e.result.status == MinimizerStatus::converged);
    CHECK((e.q.cwiseAbs() - Vec3(1, 1, 1)).norm() < 1e-5);
  }
}
