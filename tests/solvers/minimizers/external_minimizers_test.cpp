// External minimisers report defective objectives.
#include <catch2/catch.hpp>
#include <functional>
#include <limits>
#include <stdexcept>

#include "framework/core/minimizer.hpp"
#include "tests/support/component_variants.hpp"

using namespace tack;

namespace {

// Three unknowns; value and gradient as given.
class TestObjective : public Objective {
 public:
  TestObjective(std::function<double(const Vec3&)> value, std::function<Vec3(const Vec3&)> gradient)
      : value_(std::move(value)), gradient_at_(std::move(gradient)) {
    matrix_.column_start = {0, 1};
    matrix_.row = {0};
    matrix_.values = {1, 0, 0, 0, 1, 0, 0, 0, 1};
  }
  int size() const override { return 3; }
  void move_to(const VecX& q) override { q_ = q; }
  double value() override { return ++count_, value_(q_); }
  double value_noise() const override { return 0; }
  const VecX& gradient() override { return gradient_ = gradient_at_(q_); }
  const BlockMatrix& hessian(const HessianRequest&) override { return matrix_; }
  int value_count() const override { return count_; }

 private:
  std::function<double(const Vec3&)> value_;
  std::function<Vec3(const Vec3&)> gradient_at_;
  Vec3 q_;
  VecX gradient_;
  BlockMatrix matrix_;
  int count_ = 0;
};

MinimizerResult minimize(const std::string& yaml, TestObjective& objective, VecX& q, double feasible = 1) {
  PhaseClock clock;
  const auto minimizer = component<Minimizer>(yaml);
  return minimizer->minimize({objective, [=](const VecX&, const VecX&) { return feasible; },
                              [](const VecX&, const VecX& g) { return g.norm() / 1e-6; }, clock, false}, q);
}

double bowl(const Vec3& q) { return 0.5 * q.squaredNorm() + std::pow(q(0), 4); }
Vec3 bowl_slope(const Vec3& q) { return q + Vec3(4 * std::pow(q(0), 3), 0, 0); }

const std::vector<std::string> gradient_methods = {
    "{type: ceres_line_search}", "{type: ceres_line_search, direction: bfgs}",
    "{type: ceres_line_search, direction: nonlinear_conjugate_gradients}", "{type: nlopt}",
    "{type: nlopt, algorithm: tnewton}", "{type: nlopt, algorithm: tnewton_precond_restart}",
    "{type: nlopt, algorithm: var1}", "{type: nlopt, algorithm: var2}", "{type: nlopt, algorithm: mma}",
    "{type: nlopt, algorithm: ccsaq}", "{type: nlopt, algorithm: slsqp}"};

const VecX start = Vec3(1, -2, 0.5);

template <class Check>
void for_each_method(const Check& check) {
  for (const std::string& yaml : gradient_methods) {
    INFO(yaml);
    check(yaml);
  }
}

}  // namespace

TEST_CASE("external minimizers: a bowl", "[minimizer]") {
  for_each_method([](const std::string& yaml) {
    TestObjective objective(bowl, bowl_slope);
    VecX q = start;
    const MinimizerResult result = minimize(yaml, objective, q);
    CHECK(result.status == MinimizerStatus::converged);
    CHECK(q.norm() < 1e-6);
  });
}

TEST_CASE("external minimizers: no feasible direction", "[minimizer]") {
  for_each_method([](const std::string& yaml) {
    TestObjective objective(bowl, bowl_slope);
    VecX q = start;
    CHECK(minimize(yaml, objective, q, 0).status == MinimizerStatus::blocked);
    CHECK(q == start);
    CHECK(objective.value_count() < 1000);
  });
}

TEST_CASE("external minimizers: a gradient that lies", "[minimizer]") {
  for_each_method([](const std::string& yaml) {
    TestObjective objective(bowl, [](const Vec3& q) { return Vec3(-bowl_slope(q)); });
    VecX q = start;
    const MinimizerResult result = minimize(yaml, objective, q);
    // A method may accept a lower value; no method claims convergence elsewhere.
    CHECK((result.status == MinimizerStatus::line_search_failed || result.status == MinimizerStatus::iteration_limit ||
           q.norm() < 1e-6));
    CHECK(bowl(q) <= bowl(start));
  });
}

TEST_CASE("external minimizers: values that are not numbers", "[minimizer]") {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  for_each_method([=](const std::string& yaml) {
    VecX q = start;
    TestObjective never([=](const Vec3&) { return nan; }, bowl_slope);
    CHECK(minimize(yaml, never, q).status == MinimizerStatus::not_finite);
    TestObjective slopeless(bowl, [=](const Vec3&) { return Vec3(nan, 0, 0); });
    CHECK(minimize(yaml, slopeless, q).status == MinimizerStatus::not_finite);
    CHECK(q == start);
    // Only on the other side of a wall: it can be gone round.
    TestObjective half([=](const Vec3& at) { return at(1) > 0.1 ? nan : bowl(at); }, bowl_slope);
    CHECK(minimize(yaml, half, q).status == MinimizerStatus::converged);
    CHECK(q.norm() < 1e-6);
  });
}

TEST_CASE("external minimizers: exceptions of the objective are rethrown", "[minimizer]") {
  for_each_method([](const std::string& yaml) {
    int calls = 0;
    TestObjective objective([&](const Vec3& q) { return ++calls > 3 ? throw std::runtime_error("broken") : bowl(q); }, bowl_slope);
    VecX q = start;
    CHECK_THROWS_WITH(minimize(yaml, objective, q), "broken");
  });
}
