// Intervals, correlations and combinations against least squares in closed form; the combinations
// that a cantilever does not determine.
#include "framework/calibrate/confidence.hpp"

#include <catch2/catch.hpp>

#include "framework/calibrate/derivatives.hpp"
#include "tests/framework/calibrate/pulled_patch.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

std::vector<FittedParameter> two(bool log = true) {
  std::vector<FittedParameter> all(2);
  all[0].name = "strength";
  all[1].name = "work";
  for (FittedParameter& n : all) n.from = 0.01, n.to = 100, n.log = log;
  return all;
}

}  // namespace

TEST_CASE("standard deviations and correlation of a straight line agree with linear regression", "[calibrate]") {
  // r_i = (a + b x_i - y_i) / s with x = 0 ... 9: var a = s^2 (1/n + m^2 / S), var b = s^2 / S, cov = -s^2 m / S, with the mean m of x and the sum S of (x - m)^2.
  const int n = 10;
  Eigen::MatrixXd j(n, 2);
  std::vector<double> residuals;
  for (int i = 0; i < n; ++i) {
    j.row(i) << 1, i;
    residuals.push_back(i % 2 ? 0.5 : -0.5);
  }
  const double m = 4.5, s2 = 82.5, left = std::sqrt(0.25 * n / (n - 2));
  std::vector<FittedParameter> line = two(false);
  for (FittedParameter& parameter : line) parameter.from = 0, parameter.to = 3;  // u is the value
  const Confidence known = find_confidence(line, {1, 1}, j, residuals, true), estimated = find_confidence(line, {1, 1}, j, residuals, false);
  CHECK(known.noise == 1);
  CHECK(estimated.noise == Approx(left));
  CHECK(known.sigma[0] == Approx(std::sqrt(1. / n + m * m / s2)));
  CHECK(known.sigma[1] == Approx(std::sqrt(1 / s2)));
  CHECK(estimated.sigma[1] == Approx(left * std::sqrt(1 / s2)));
  CHECK(known.correlation(0, 1) == Approx(-m / std::sqrt(s2 / n + m * m)));
  CHECK(known.high[1] - 1 == Approx(1.959964 * known.sigma[1]));
  CHECK(estimated.high[1] - 1 == Approx(2.306004 * estimated.sigma[1]));  // Student's t of 8
  CHECK(1 - estimated.low[1] == Approx(estimated.high[1] - 1));
}

TEST_CASE("data that depend on a product determine the product alone, with a warning", "[calibrate]") {
  Eigen::MatrixXd j(30, 2);
  std::vector<double> residuals;
  for (int i = 0; i < 30; ++i) {
    j.row(i) << 10. + i, 10. + i;
    residuals.push_back(0);
  }
  const Confidence c = find_confidence(two(), {1, 1}, j, residuals, true);
  CHECK(std::isinf(c.sigma[0]));
  CHECK(std::isinf(c.sigma[1]));
  CHECK(std::isnan(c.correlation(0, 1)));
  CHECK(std::isinf(c.high[0]));
  CHECK(c.low[0] == 0);
  CHECK(c.combinations[0].text == "strength work");
  CHECK(std::isinf(c.combinations[1].sigma));
  CHECK_THAT(only_text(c.warnings, WarningKind::undetermined_value), Catch::StartsWith("the data do not determine strength (not at all) and work (not at all); only strength work (to ") &&
                                Catch::EndsWith(" is determined"));
}

TEST_CASE("a cantilever determines the work and not the strength, a pulled patch both", "[calibrate]") {
  const std::vector<FittedParameter> parameters = two();
  const auto confidence = [&](const ModelEvaluator::Model& model, const DesignPoint& truth) {
    const std::vector<double> data = model(truth);
    ModelEvaluator evaluator(model, data, 0.02 * *std::max_element(data.begin(), data.end()));
    const PointEvaluation middle = evaluator.at({truth}).front();
    const std::vector<double> u{parameters[0].u(truth[0]), parameters[1].u(truth[1])};
    const Derivatives d = derivatives_at(parameters, u, 0.05, middle, [&](const std::vector<DesignPoint>& points) { return evaluator.at(points); });
    REQUIRE(d.problem.empty());
    return find_confidence(parameters, truth, d.jacobian, middle.residuals, true);
  };
  const Confidence cantilever = confidence([](const DesignPoint& p) { return cantilever_curve(1e4 * p[0], p[1]); }, {1, 1});
  CHECK(cantilever.sigma[0] == Approx(0.445).epsilon(0.02));
  CHECK(cantilever.sigma[1] == Approx(0.016).epsilon(0.05));
  CHECK(cantilever.correlation(0, 1) == Approx(-0.97).margin(0.01));
  CHECK_THAT(first_text(cantilever.warnings, WarningKind::undetermined_value), Catch::Contains("do not determine strength") && Catch::Contains("only strength^0.0"));
  const PulledPatch patch;
  const Confidence pull = confidence([&](const DesignPoint& p) { return patch.curve(1e4 * p[0], p[1], 2e8); }, {1, 1});
  CHECK(pull.sigma[0] == Approx(0.005).epsilon(0.1));
  CHECK(pull.sigma[1] == Approx(0.004).epsilon(0.1));
  CHECK(pull.warnings.empty());
}

TEST_CASE("large residuals and too few points give warnings", "[calibrate]") {
  Eigen::MatrixXd j = Eigen::MatrixXd::Random(20, 2);
  CHECK_THAT(first_text(find_confidence(two(), {1, 1}, j, std::vector<double>(20, 5.0), true).warnings, WarningKind::model_misfit), Catch::Contains("5.3 times the noise"));
  const Confidence few = find_confidence(two(), {1, 1}, j.topRows(2), {0.1, 0.1}, false);
  CHECK_THAT(first_text(few.warnings, WarningKind::few_points), Catch::Contains("2 measured points are too few for confidence intervals of 2 parameters"));
}

namespace {

struct Coverage {
  double covered = 0, flagged = 0, covered_or_flagged = 0, width = 0;
};

// Fits straight lines a + b x to 100 points of the truth 1 + 2 x + curvature x^2, with noise of standard deviation 0.1 and correlation `correlated` of neighbouring points.
// Least squares give a and b in closed form, with known or estimated noise.
Coverage of_lines(double curvature, double correlated, bool known, double stated_noise = 0.1) {
  const int n = 100, fits = 200;
  std::vector<FittedParameter> line = two(false);
  for (FittedParameter& parameter : line) parameter.from = 0, parameter.to = 3;  // u is the value
  Eigen::MatrixXd j(n, 2);
  for (int i = 0; i < n; ++i) j.row(i) << 1, i / double(n);
  Coverage c;
  for (int seed = 1; seed <= fits; ++seed) {
    Noise random(static_cast<unsigned>(seed));
    Eigen::VectorXd y(n);
    double error = random.next();
    for (int i = 0; i < n; ++i) {
      const double x = j(i, 1);
      y[i] = 1 + 2 * x + curvature * x * x + 0.1 * error;
      error = correlated * error + std::sqrt(1 - correlated * correlated) * random.next();
    }
    const Eigen::VectorXd best = (j.transpose() * j).ldlt().solve(j.transpose() * y);
    const double unit = known ? stated_noise : 1;
    const Eigen::VectorXd r = (j * best - y) / unit;
    const Confidence one = find_confidence(line, {best[0], best[1]}, j / unit, {r.data(), r.data() + n}, known);
    const bool covered = one.low[1] <= 2 && 2 <= one.high[1];
    c.covered += covered / double(fits);
    c.flagged += !one.fits / double(fits);
    c.covered_or_flagged += (covered || !one.fits) / double(fits);
    c.width += (one.high[1] - one.low[1]) / fits;
  }
  return c;
}

}  // namespace

TEST_CASE("intervals contain the true value, or the fit is flagged", "[calibrate]") {
  for (const bool known : {true, false}) {
    CAPTURE(known);
    const Coverage white = of_lines(0, 0, known);
    CHECK(white.covered >= 0.93);
    CHECK(white.flagged <= 0.06);
    CHECK(white.width == Approx(2 * 1.96 * 0.1 / std::sqrt(100 / 12.)).epsilon(0.05));

    const Coverage correlated = of_lines(0, 0.9, known);
    UNSCOPED_INFO("correlated: covered " << correlated.covered << ", flagged " << correlated.flagged);
    CHECK(correlated.covered >= 0.8);
    CHECK(correlated.covered_or_flagged >= 0.99);
    CHECK(correlated.width > 2.5 * white.width);

    for (const double curvature : {1.2, 3.0}) {
      CAPTURE(curvature);
      CHECK(of_lines(curvature, 0, known).flagged >= 0.97);
      CHECK(of_lines(curvature, 0.9, known).covered_or_flagged >= 0.97);
    }
  }
  // The noise is larger than stated.
  const Coverage understated = of_lines(0, 0, true, 0.06);
  CHECK(understated.flagged >= 0.99);
  CHECK(understated.covered >= 0.93);
}

TEST_CASE("residuals of different experiments are not correlated with each other", "[calibrate]") {
  std::vector<double> residuals;
  for (int e = 0; e < 20; ++e)
    for (int i = 0; i < 2; ++i) residuals.push_back(i == 0 ? 1 : -1);
  residuals.insert(residuals.end(), residuals.begin(), residuals.end());
  const std::vector<size_t> pairs(40, 2);
  CHECK(residual_statistics(residuals, 2, true, pairs).effective_points == 80);
  for (size_t i = 0; i < residuals.size(); ++i) residuals[i] = (i / 2) % 2 == 0 ? 1 : -1;
  CHECK(residual_statistics(residuals, 2, true, pairs).effective_points == Approx(40));
  CHECK(residual_statistics(residuals, 2, true, {80}).effective_points == 80);
}
