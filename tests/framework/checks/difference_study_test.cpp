#include "framework/checks/difference_study.hpp"

#include <catch2/catch.hpp>
#include <cmath>
#include <functional>
#include <random>

using namespace tack;

namespace {

// The errors of central differences of f at x against `claimed` along the study's steps.
std::vector<VecX> errors_of(const std::function<double(double)>& f, double x, double claimed) {
  std::vector<VecX> errors;
  double s = DifferenceStudy::first_step;
  for (int k = 0; k < DifferenceStudy::steps; ++k, s /= DifferenceStudy::ratio)
    errors.push_back(VecX::Constant(1, (f(x + s) - f(x - s)) / (2 * s) - claimed));
  return errors;
}

DifferenceStudy study(const std::function<double(double)>& f, double x, double claimed) {
  return study_differences(errors_of(f, x, claimed), VecX::Constant(1, std::abs(claimed)), 1e-6);
}

double noisy(double x) {  // rounding as of coordinates that are a million times the step
  return std::exp(x) + 1e-9 * std::sin(1e15 * x);
}

}  // namespace

TEST_CASE("derivatives that are right are found right, near rounding and kinks too", "[scene]") {
  const auto exponential = [](double x) { return std::exp(x); };
  CHECK_FALSE(study(exponential, 0.3, std::exp(0.3)).wrong);
  CHECK(study(exponential, 0.3, std::exp(0.3)).error < 1e-9);
  CHECK_FALSE(study(noisy, 0.3, std::exp(0.3)).wrong);
  const auto kinked = [](double x) { return x < 0 ? x : 3 * x; };
  CHECK_FALSE(study(kinked, 1e-4, 3).wrong);
  CHECK(study(kinked, 1e-4, 3).error < 1e-9);
  CHECK(study(kinked, 1e-9, 3).unclear == 1);
}

TEST_CASE("derivatives that are off by a hundred-thousandth are found wrong, by more near rounding", "[scene]") {
  const auto exponential = [](double x) { return std::exp(x); };
  const DifferenceStudy slightly = study(exponential, 0.3, std::exp(0.3) * (1 + 1e-5));
  CHECK(slightly.wrong);
  CHECK(slightly.error == Approx(1e-5).epsilon(1e-2));
  CHECK(study(noisy, 0.3, std::exp(0.3) * 1.03).wrong);
  CHECK(study([](double) { return 0.0; }, 0.3, 1).wrong);  // a slope that nothing has
  CHECK(study([](double x) { return x; }, 0.3, 0).wrong);  // none where there is one
}

TEST_CASE("where value and derivative vanish, there is no scale", "[scene]") {
  const DifferenceStudy nothing = study([](double) { return 0.0; }, 0.3, 0);
  CHECK(nothing.scale == 0);
  CHECK_FALSE(nothing.wrong);
}

TEST_CASE("one wrong component among many noisy ones is found, and no noise is", "[scene]") {
  std::mt19937 random(3);
  std::normal_distribution<double> noise;
  for (const double wrong : {0.0, 0.03}) {
    std::vector<VecX> errors;
    double s = DifferenceStudy::first_step;
    for (int k = 0; k < DifferenceStudy::steps; ++k, s /= DifferenceStudy::ratio) {
      errors.push_back(VecX::NullaryExpr(3000, [&] { return s * s + 1e-9 / s * noise(random); }));
      errors.back()(1234) += wrong;
    }
    const DifferenceStudy found = study_differences(errors, VecX::Ones(3000), 1e-6);
    CHECK(found.wrong == (wrong > 0));
    CHECK(found.resolution > 1e-7);
  }
}

TEST_CASE("errors of a derivative within its own round-off are none", "[scene]") {
  const std::vector<VecX> errors(DifferenceStudy::steps, VecX::Constant(1, 5e-5));
  const VecX scale = VecX::Ones(1);
  CHECK(study_differences(errors, scale, 1e-6).wrong);
  CHECK(study_differences(errors, scale, 1e-6, VecX::Constant(1, 4e-5)).wrong);
  const DifferenceStudy right = study_differences(errors, scale, 1e-6, VecX::Constant(1, 6e-5));
  CHECK((!right.wrong && right.unclear == 0 && right.error == Approx(5e-5).epsilon(1e-3)));
}
