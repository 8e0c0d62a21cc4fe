// Tableaux of Runge-Kutta methods: what is refused, and tableaux that depend on a parameter.
#include "framework/stepping/integrators/runge_kutta.hpp"

#include <catch2/catch.hpp>
#include <cmath>

#include "geometry/errors.hpp"

using namespace tack;

namespace {

struct Method : RungeKutta {
  using RungeKutta::Matrix;
  Method(std::vector<double> ends, Matrix rows, std::vector<double> embedded = {}) : RungeKutta(std::move(ends), std::move(rows), std::move(embedded)) {}
  using RungeKutta::set_tableau;
};

std::string refusal(std::vector<double> ends, Method::Matrix rows, std::vector<double> embedded = {}) {
  try {
    Method(std::move(ends), std::move(rows), std::move(embedded));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

}  // namespace

TEST_CASE("tableaux that are no A-stable implicit methods are refused with the fault", "[integrators]") {
  using Catch::Contains;
  CHECK(refusal({1}, {{0, 1}}) == "");
  CHECK(refusal({1}, {{0.5, 0.5}}) == "");
  CHECK_THAT(refusal({}, {}), Contains("a row per stage"));
  CHECK_THAT(refusal({0.5, 1}, {{0, 0.5}}), Contains("a row per stage"));
  CHECK_THAT(refusal({0.5, 0.5}, {{0, 0.5}, {0, 0, 0.5}}), Contains("ascend"));
  CHECK_THAT(refusal({0.5}, {{0, 0.5}}), Contains("the last stage must end at 1"));
  CHECK_THAT(refusal({1}, {{1}}), Contains("row 1 has 1 entries instead of 2"));
  CHECK_THAT(refusal({1}, {{1, 0}}), Contains("the diagonal of row 1 must be positive"));
  CHECK_THAT(refusal({1}, {{0.4, 0.5}}), Contains("row 1 adds up to 0.9"));
  CHECK_THAT(refusal({1}, {{0, 1}}, {0.5, 0.4}), Contains("2 numbers that add up to 1"));
  CHECK_THAT(refusal({1}, {{0.6, 0.4}}), Contains("not A-stable"));
  // Two trapezoidal rules and BDF3 over thirds of the step.
  CHECK_THAT(refusal({1.0 / 3, 2.0 / 3, 1}, {{1.0 / 6, 1.0 / 6}, {1.0 / 6, 1.0 / 3, 1.0 / 6}, {9.0 / 66, 27.0 / 66, 18.0 / 66, 12.0 / 66}}),
             Contains("not A-stable: an oscillation of omega h = 6.04 grows by a factor of 1.128 per step"));
}

TEST_CASE("a tableau can be replaced", "[integrators]") {
  Method method({1}, {{0, 1}});
  CHECK(method.stages() == std::vector<double>{1});
  method.set_tableau({0.5, 1}, {{0.25, 0.25}, {0.25, 0.5, 0.25}});
  CHECK(method.stages() == std::vector<double>{0.5, 1});
  State state;
  state.x = VecX::Zero(3), state.v = VecX::Ones(3), state.a = VecX::Zero(3);
  CHECK(method.predict({state, 0.1}).scale == Approx(0.2 * 0.2 / 64));
}

TEST_CASE("contact acts on positions with the weights of the stages", "[integrators]") {
  // k of docs/theory/integrators.md, contact in several stages
  const auto weights = [](const char* name) {
    const std::unique_ptr<TimeIntegrator> method = Registry<TimeIntegrator>::make(name);
    State start;
    start.x = start.v = start.a = VecX::Zero(3);
    std::vector<StageEnd> ends;
    std::vector<double> found;
    double from = 0;
    for (const double end : method->stages()) {
      const double length = 0.1 * (end - from);
      found.push_back(method->predict({start, length, start, 0.1, ends}).contact_scale / (length * length));
      ends.push_back({start.x, start.v, start.a, {}});
      from = end;
    }
    return found;
  };
  CHECK(weights("tr_bdf2")[0] == Approx(0.5));
  CHECK(weights("tr_bdf2")[1] == Approx(1 / std::sqrt(2.0)));
  CHECK(weights("sdirk2")[0] == Approx(1));
  CHECK(weights("sdirk2")[1] == Approx(0.5));
}

TEST_CASE("generalised-alpha multiplies what is infinitely fast by 0.8 per step unless told otherwise", "[integrators]") {
  const std::unique_ptr<TimeIntegrator> method = Registry<TimeIntegrator>::make("generalised_alpha");
  constexpr double h = 1, stiffness = 1e12;  // x'' = - stiffness x
  State s;
  s.x = VecX::Ones(3), s.v = VecX::Zero(3), s.a = -stiffness * s.x;
  double ratio = 0;
  for (int i = 0; i < 400; ++i) {
    const StepStage stage(s, h);
    const TimeIntegrator::Prediction prediction = method->predict(stage);
    StageEnd end{prediction.x / (1 + prediction.scale * stiffness), {}, {}, {}};
    method->update(stage, end.x, {}, end.v, end.a);
    method->store(stage, end, {}, s.history);
    ratio = std::abs(end.a(0) / s.a(0));
    s.x_before = s.x, s.v_before = s.v, s.h_before = h;
    s.x = end.x, s.v = end.v, s.a = end.a;
  }
  CHECK(ratio == Approx(0.8).epsilon(0.01));  // a double root: 0.8 (1 + 1 / n) after n steps
}
