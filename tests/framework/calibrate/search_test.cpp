// The search on models in closed form: it finds the parameters of the data from distant initial
// guesses, through the same points every time.
#include "framework/calibrate/search.hpp"

#include <catch2/catch.hpp>
#include <set>

#include "framework/calibrate/confidence.hpp"
#include "geometry/errors.hpp"
#include "tests/framework/calibrate/pulled_patch.hpp"
#include "tests/support/warnings.hpp"

using namespace tack;

namespace {

const double strength = 1e4, work = 1, stiffness = 2e8, noise = 200;

// Fitted parameters with ranges from a 20th to six times the true value.
std::vector<FittedParameter> parameters(const std::vector<double>& truth, double off) {
  std::vector<FittedParameter> all;
  for (size_t i = 0; i < truth.size(); ++i) {
    FittedParameter n;
    n.name = i == 0 ? "strength" : i == 1 ? "work" : "stiffness";
    n.from = truth[i] / 20;
    n.to = truth[i] * 6;
    n.start = truth[i] * (i == 1 ? 1 / off : off);
    n.log = true;
    all.push_back(n);
  }
  return all;
}

std::vector<double> noisy(std::vector<double> curve, double deviation, unsigned seed) {
  Noise random(seed);
  for (double& y : curve) y += deviation * random.next();
  return curve;
}

const SearchProgress silent = [](const std::string&, int, const PointEvaluation*) {};

SearchResult pulled(unsigned seed, double off, int unknowns, double jitter = 0) {
  const PulledPatch patch;
  ModelEvaluator evaluator(
      [&](const DesignPoint& p) {
        std::vector<double> force = patch.curve(p[0], p[1], unknowns > 2 ? p[2] : stiffness);
        Noise random(static_cast<unsigned>(p[0]) + 31 * static_cast<unsigned>(1e4 * p[1]) + seed);
        for (double& f : force) f *= 1 + jitter * random.next();
        return force;
      },
      noisy(patch.curve(strength, work, stiffness), noise, seed), noise);
  std::vector<double> truth{strength, work, stiffness};
  truth.resize(static_cast<size_t>(unknowns));
  return search_for(parameters(truth, off), {}, evaluator, silent);
}

bool right(const SearchResult& found) {
  return std::abs(found.best.values[0] / strength - 1) < 0.03 && std::abs(found.best.values[1] / work - 1) < 0.03;
}

}  // namespace

TEST_CASE("strength and work of a pulled patch are found within 3% from initial guesses wrong by a factor of 3", "[calibrate]") {
  for (const int unknowns : {2, 3})
    for (const double jitter : {0.0, 1e-3, 1e-2}) {  // relative noise of the model, as of runs with loose tolerances
      int good = 0;
      for (unsigned seed = 1; seed <= 12; ++seed) {
        const SearchResult found = pulled(seed, seed % 2 ? 3 : 1. / 3, unknowns, jitter);
        good += right(found) ? 1 : 0;
        CHECK(found.rows.size() <= (unknowns == 2 ? 160 : 260));
      }
      CAPTURE(unknowns, jitter);
      CHECK(good >= 11);
    }
}

TEST_CASE("a search with sensitivities of the runs finds the optimum with fewer points", "[calibrate]") {
  const PulledPatch patch;
  const auto curve = [&](const DesignPoint& p) { return patch.curve(p[0], p[1], p.size() > 2 ? p[2] : stiffness); };
  for (const int unknowns : {2, 3}) {
    std::vector<double> truth{strength, work, stiffness};
    truth.resize(static_cast<size_t>(unknowns));
    int good = 0, from_runs = 0;
    size_t points = 0, before = 0;
    for (unsigned seed = 1; seed <= 12; ++seed) {
      ModelEvaluator evaluator(curve, noisy(curve(truth), noise, seed), noise, curve, std::vector<std::string>(truth.size()));
      const SearchResult found = search_for(parameters(truth, seed % 2 ? 3 : 1. / 3), {}, evaluator, silent);
      good += right(found) ? 1 : 0;
      points += found.rows.size();
      before += pulled(seed, seed % 2 ? 3 : 1. / 3, unknowns).rows.size();
      REQUIRE(found.derivatives.problem.empty());
      from_runs += found.derivatives.from_runs[0] ? 1 : 0;
      CHECK(found.derivatives.from_runs[0] == found.derivatives.why[0].empty());
      if (!found.derivatives.from_runs[0]) CHECK_THAT(found.derivatives.why[0], Catch::Contains("the curves have steps there"));
    }
    CAPTURE(unknowns, points, before, from_runs);
    CHECK(good >= 11);
    CHECK(from_runs >= 1);
    CHECK(points < before);
  }
}

TEST_CASE("finite differences replace missing sensitivities, and all of them if some are wrong", "[calibrate]") {
  // A smooth model of two parameters; one has no sensitivities.
  const auto model = [](const DesignPoint& p) {
    std::vector<double> y;
    for (int i = 0; i < 30; ++i) y.push_back(p[0] * std::sin(0.2 * i) + 1e4 * p[1] * std::cos(0.3 * i));
    return y;
  };
  const std::vector<double> data = noisy(model({strength, work}), noise, 1);
  ModelEvaluator one(model, data, noise, model, {"", "it changes the mesh"});
  const SearchResult mixed = search_for(parameters({strength, work}, 3), {}, one, silent);
  CHECK(right(mixed));
  CHECK(mixed.derivatives.from_runs == std::vector<bool>{true, false});
  CHECK(mixed.derivatives.why == std::vector<std::string>{"", "it changes the mesh"});
  CHECK(mixed.derivatives.missed < 0.1);
  CHECK(mixed.derivatives.compared > 3);
  ModelEvaluator reference(model, data, noise);
  const SearchResult differenced = search_for(parameters({strength, work}, 3), {}, reference, silent);
  CHECK((mixed.derivatives.jacobian - differenced.derivatives.jacobian).norm() < 0.02 * differenced.derivatives.jacobian.norm());
  CHECK(one.runs < reference.runs);

  ModelEvaluator wrong(model, data, noise, [&](const DesignPoint& p) { return model({p[1] * strength, p[0] / strength}); }, {"", ""});
  const SearchResult distrusted = search_for(parameters({strength, work}, 3), {}, wrong, silent);
  CHECK(right(distrusted));
  CHECK(wrong.differentiated == 1);
  CHECK(distrusted.derivatives.from_runs == std::vector<bool>{false, false});
  CHECK_THAT(distrusted.derivatives.why[1], Catch::Contains("nearby evaluations unexplained"));
  CHECK(distrusted.derivatives.missed > 0.5);

  SearchConfig off;
  off.gradients = false;
  ModelEvaluator unasked(model, data, noise, model, {"", ""});
  CHECK(search_for(parameters({strength, work}, 3), off, unasked, silent).best.values == differenced.best.values);
  CHECK(unasked.differentiated == 0);
}

TEST_CASE("undetermined parameters get finite differences, since ripples of a curve mislead local sensitivities", "[calibrate]") {
  for (const double waves : {0.0, 60.0, 100.0}) {
    CAPTURE(waves);
    const auto rippled = [&](const DesignPoint& p) {
      std::vector<double> force = cantilever_curve(p[0], p[1]);
      for (size_t i = 0; i < force.size(); ++i) force[i] *= 1 + 1e-3 * std::sin(waves * std::log(p[0]) + static_cast<double>(i));
      return force;
    };
    const std::vector<double> truth = rippled({strength, work});
    const double deviation = 0.02 * *std::max_element(truth.begin(), truth.end());
    const std::vector<double> data = noisy(truth, deviation, 2);
    ModelEvaluator with(rippled, data, deviation, rippled, {"", ""});
    const SearchResult found = search_for(parameters({strength, work}, 3), {}, with, silent);
    CHECK_FALSE(found.derivatives.from_runs[0]);
    CHECK_THAT(found.derivatives.why[0], Catch::Contains("sensitivities"));
    const Confidence c = find_confidence(parameters({strength, work}, 3), found.best.values, found.derivatives.jacobian, found.best.residuals, true);
    CHECK(c.sigma[0] > 0.2);
    CHECK(c.sigma[1] < 0.03);
  }
}

TEST_CASE("a search requests equal points every time, each once, and its intervals contain the true values", "[calibrate]") {
  const SearchResult a = pulled(3, 3, 2), b = pulled(3, 3, 2);
  REQUIRE(a.rows.size() == b.rows.size());
  std::set<DesignPoint> points;
  for (size_t i = 0; i < a.rows.size(); ++i) {
    CHECK(a.rows[i].evaluation.values == b.rows[i].evaluation.values);
    CHECK(points.insert(a.rows[i].evaluation.values).second);
  }
  REQUIRE(a.derivatives.problem.empty());
  int covered = 0;
  for (unsigned seed = 1; seed <= 40; ++seed) {
    const SearchResult found = pulled(seed, 3, 2);
    const Confidence c = find_confidence(parameters({strength, work}, 3), found.best.values, found.derivatives.jacobian, found.best.residuals, seed % 2 == 0);
    covered += c.low[0] <= strength && strength <= c.high[0] ? 1 : 0;
    covered += c.low[1] <= work && work <= c.high[1] ? 1 : 0;
  }
  CHECK(covered >= 70);  // of 80, 76 on average
}

TEST_CASE("failed points do not end a search, unless the whole design fails", "[calibrate]") {
  const PulledPatch patch;
  const std::vector<double> data = noisy(patch.curve(strength, work, stiffness), noise, 5);
  ModelEvaluator half([&](const DesignPoint& p) { return p[0] > 1.3 * strength || p[1] > 2 * work ? std::vector<double>{} : patch.curve(p[0], p[1], stiffness); }, data, noise);
  const SearchResult found = search_for(parameters({strength, work}, 3), {}, half, silent);
  CHECK(right(found));
  CHECK(std::count_if(found.rows.begin(), found.rows.end(), [](const SearchRow& row) { return !row.evaluation.good; }) > 5);
  ModelEvaluator none([](const DesignPoint&) { return std::vector<double>{}; }, data, noise);
  CHECK_THROWS_WITH(search_for(parameters({strength, work}, 3), {}, none, silent), Catch::Contains("all 64 evaluations of the initial design failed"));
}

TEST_CASE("a search respects bounds and its limit of evaluations, and fits a single parameter", "[calibrate]") {
  const PulledPatch patch;
  ModelEvaluator evaluator([&](const DesignPoint& p) { return patch.curve(p[0], work, stiffness); }, patch.curve(strength, work, stiffness), noise);
  const SearchResult one = search_for(parameters({strength}, 3), {}, evaluator, silent);
  CHECK(one.best.values[0] == Approx(strength).epsilon(0.001));

  std::vector<FittedParameter> low = parameters({strength, work}, 1. / 3);
  low[0].to = 0.5 * strength;
  ModelEvaluator bounded([&](const DesignPoint& p) { return patch.curve(p[0], p[1], stiffness); }, patch.curve(strength, work, stiffness), noise);
  const SearchResult found = search_for(low, {}, bounded, silent);
  for (const SearchRow& row : found.rows) CHECK(row.evaluation.values[0] <= low[0].to);
  const Confidence c = find_confidence(low, found.best.values, found.derivatives.jacobian, found.best.residuals, true);
  CHECK_THAT(first_text(c.warnings, WarningKind::value_at_bound), Catch::Contains("strength ended at its bound 'to'"));

  SearchConfig few;
  few.evaluations = 30;
  few.design = 20;
  few.polish = false;
  ModelEvaluator counted([&](const DesignPoint& p) { return patch.curve(p[0], p[1], stiffness); }, patch.curve(strength, work, stiffness), noise);
  CHECK(search_for(parameters({strength, work}, 3), few, counted, silent).rows.size() <= 30 + 4);
}

TEST_CASE("parameters on a linear scale are found, including negative values", "[calibrate]") {
  std::vector<FittedParameter> all(2);
  for (FittedParameter& n : all) n.from = -2, n.to = 4, n.start = 3.5;
  all[0].name = "a";
  all[1].name = "b";
  const auto model = [](const DesignPoint& p) {
    std::vector<double> y;
    for (int i = 0; i < 20; ++i) y.push_back(p[0] * std::sin(0.3 * i) + p[1] * p[0] + p[1]);
    return y;
  };
  ModelEvaluator evaluator(model, model({-1.25, 0.5}), 0.01);
  const SearchResult found = search_for(all, {}, evaluator, silent);
  CHECK(found.best.values[0] == Approx(-1.25).margin(0.01));
  CHECK(found.best.values[1] == Approx(0.5).margin(0.01));
}
