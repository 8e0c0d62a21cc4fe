// The step size controller in isolation: a run is a sequence of verdicts, without a world.
#include "framework/stepping/step_size.hpp"

#include <catch2/catch.hpp>
#include <cmath>

using namespace tack;

namespace {

TimeConfig constant(int max_cutbacks = 8) {
  TimeConfig time;
  time.step = 0.01;
  time.max_cutbacks = max_cutbacks;
  return time;
}

TimeConfig adaptive(double largest = 0.04) {
  TimeConfig time = constant();
  time.adaptive.emplace();
  time.adaptive->smallest = 1e-4;
  time.adaptive->largest = largest;
  return time;
}

struct Run {
  explicit Run(TimeConfig of_run, std::vector<double> corners = {}) : time(std::move(of_run)), sizes(time, state, std::move(corners)) {}
  double begin() {
    sizes.begin();
    return sizes.next();
  }
  bool reject(Rejection reason, double factor) {
    const bool rejected = sizes.reject(reason, factor);
    if (rejected) sizes.next();
    return rejected;
  }
  // Accepts the present try, and returns its size.
  double accept(const ErrorRatio& error = {}) {
    const double h = sizes.next();
    state.time += h;
    sizes.accept(error);
    return h;
  }
  double step(const ErrorRatio& error = {}) {
    begin();
    return accept(error);
  }

  TimeConfig time;
  State state;
  StepSizeController sizes;
};

const Rejection cutbacks[] = {Rejection::solve, Rejection::inversion, Rejection::intersection, Rejection::tunnelling, Rejection::debonding};

}  // namespace

TEST_CASE("constant steps that are accepted have the size of the scene", "[step_size]") {
  Run run(constant());
  for (int i = 0; i < 100; ++i) CHECK(run.step() == 0.01);
}

TEST_CASE("a cut size stays until the end of the whole step", "[step_size]") {
  for (const Rejection reason : cutbacks) {
    Run run(constant());
    run.step();
    CHECK(run.begin() == 0.01);
    CHECK(run.reject(reason, 0.5));
    CHECK(run.reject(reason, 0.5));
    CHECK(run.sizes.rejections()[reason] == 2);
    CHECK(run.sizes.rejections().cutbacks() == 2);
    CHECK(run.accept() == 0.0025);
    for (int i = 0; i < 3; ++i) CHECK(run.step() == Approx(0.0025).epsilon(1e-12));
    CHECK(run.sizes.rejections().cutbacks() == 0);  // of the last step
    CHECK(run.state.time == Approx(0.02).epsilon(1e-14));
    CHECK(run.step() == 0.01);
  }
}

TEST_CASE("a cut in a long run, whose time has drifted off the grid, leaves no tiny step", "[step_size]") {
  Run run(constant());
  for (int i = 0; i < 3'000'000; ++i) run.step();
  REQUIRE(std::abs(run.state.time - 30'000) > 1e-9 * run.time.step);
  run.begin();
  CHECK(run.reject(Rejection::solve, 0.5));
  CHECK(run.accept() == Approx(0.005));
  CHECK(run.step() == Approx(0.005).epsilon(1e-3));
  CHECK(run.step() == 0.01);
}

TEST_CASE("a rejection with a small factor cuts at once, but not below the smallest size", "[step_size]") {
  Run run(constant(3));
  run.begin();
  CHECK(run.reject(Rejection::tunnelling, 1.0 / 4));
  CHECK(run.sizes.next() == 0.0025);
  CHECK(run.reject(Rejection::tunnelling, 1.0 / 16));
  CHECK(run.sizes.next() == 0.01 / 8);
  CHECK(run.sizes.at_smallest(Rejection::tunnelling));
  const StepSizeState before = run.state.step_size;
  CHECK_FALSE(run.reject(Rejection::tunnelling, 0.5));
  CHECK(run.state.step_size.h_next == before.h_next);
  CHECK(run.sizes.rejections()[Rejection::tunnelling] == 2);
  Run none(constant(0));
  none.begin();
  CHECK_FALSE(none.reject(Rejection::solve, 0.5));
}

TEST_CASE("a bisection for the time of an event ends steps where it looks", "[step_size]") {
  Run run(constant(30));
  constexpr double event = 0.00637;
  double low = 0, high = run.begin();
  while (high - low > 1e-6) {
    const double middle = (low + high) / 2;
    if (middle > event) {
      CHECK(run.reject(Rejection::solve, middle / run.sizes.size()));
      CHECK(run.sizes.size() == Approx(middle).epsilon(1e-12));
      high = middle;
    } else {
      low = middle;
    }
  }
  CHECK(run.accept() == Approx(event).margin(1e-6));
}

TEST_CASE("a factor of one counts a repetition by other means", "[step_size]") {
  Run run(constant(0));
  run.begin();
  CHECK(run.reject(Rejection::energy_contact, 1));
  CHECK(run.sizes.rejections().of_energy() == 1);
  CHECK(run.accept() == 0.01);
}

TEST_CASE("energy cuts steps to an eighth: for one whole step in contact, for 64 without", "[step_size]") {
  Run impact(constant());
  impact.begin();
  for (int i = 0; i < 3; ++i) CHECK(impact.reject(Rejection::energy_contact, 0.5));
  CHECK_FALSE(impact.reject(Rejection::energy_contact, 0.5));
  for (int i = 0; i < 8; ++i) CHECK((i == 0 ? impact.accept() : impact.step()) == Approx(0.01 / 8));
  CHECK(impact.step() == 0.01);

  Run spin(constant());
  spin.begin();
  CHECK(spin.reject(Rejection::energy_free, 0.5));
  CHECK(spin.reject(Rejection::energy_free, 0.5));
  CHECK(spin.state.step_size.h_max == 0.0025);
  CHECK(spin.accept() == 0.0025);
  for (int i = 1; i < 4 * 64; ++i) CHECK(spin.step() == Approx(0.0025));
  for (int i = 0; i < 2 * 64; ++i) CHECK(spin.step() == Approx(0.005));
  CHECK(spin.step() == 0.01);
  CHECK(spin.state.step_size.h_max == 0);
}

TEST_CASE("a rejection in the last substep keeps the limit on the grid of whole steps", "[step_size]") {
  Run run(constant());
  run.begin();
  run.reject(Rejection::energy_free, 0.5);
  run.accept();
  run.begin();
  run.state.step_size.h_next *= 1 + 1e-13;  // round-off
  run.reject(Rejection::energy_free, 0.5);
  CHECK(run.state.step_size.h_max == 0.0025);
}

TEST_CASE("adaptive steps have the size at which the error is 0.7 of its limit", "[step_size]") {
  Run run(adaptive(1));
  const auto error = [](double h) { return ErrorRatio{0, h * h / (0.02 * 0.02), 2}; };
  for (int i = 0; i < 20; ++i) {
    double h = run.begin();
    while (error(h).ratio > 1) {
      CHECK(run.reject(Rejection::error, run.sizes.error_factor(error(h))));
      h = run.sizes.next();
    }
    run.accept(error(h));
  }
  CHECK(run.sizes.size() == Approx(0.02 * std::sqrt(0.7)).epsilon(0.1));
}

TEST_CASE("adaptive steps grow by at most two, and to the largest", "[step_size]") {
  Run run(adaptive());
  CHECK(run.step({0, 1e-6, 2}) == 0.01);
  CHECK(run.step({0, 1e-6, 2}) == 0.02);
  CHECK(run.step({0, 1e-6, 2}) == 0.04);
  CHECK(run.step({0, 1e-6, 2}) == 0.04);
}

TEST_CASE("a step with a too large error shrinks by the power of its error, and down to the smallest", "[step_size]") {
  Run run(adaptive());
  run.begin();
  CHECK(run.reject(Rejection::error, run.sizes.error_factor({0, 7, 2})));
  CHECK(run.sizes.size() == Approx(0.01 * std::sqrt(0.1)));
  CHECK(run.sizes.whole() == run.sizes.size());  // cutbacks count from here
  // The error fell with h alone, so that the next repetition takes p = 1.
  const double h = run.sizes.next(), ratio = 7 * h / 0.01;
  CHECK(run.reject(Rejection::error, run.sizes.error_factor({0, ratio, 2})));
  CHECK(run.sizes.size() == Approx(h * 0.7 / ratio));
  while (run.reject(Rejection::error, run.sizes.error_factor({0, 1e6, 2}))) {
  }
  CHECK(run.sizes.size() == Approx(1e-4));
  CHECK(run.accept({0, 1e6, 2}) == Approx(1e-4));
  CHECK(run.sizes.size() == Approx(1e-4));
}

TEST_CASE("adaptive steps do not grow before the time at which a rejected try would have ended", "[step_size]") {
  for (const Rejection reason : {Rejection::solve, Rejection::error, Rejection::energy_contact}) {
    Run run(adaptive());
    run.begin();
    CHECK(run.reject(reason, 0.25));
    const double h = run.accept({0, 1e-6, 2});
    CHECK(h == 0.0025);
    for (int i = 0; i < 3; ++i) CHECK(run.step({0, 1e-6, 2}) == h);
    CHECK(run.step({0, 1e-6, 2}) == Approx(2 * h));
  }
}

TEST_CASE("adaptive steps end at corners, in even steps before them, and regain their size", "[step_size]") {
  Run run(adaptive(0.01), {0.025, 0.1});
  for (const double h : {0.01, 0.0075, 0.0075}) CHECK(run.step({0, 0.7, 2}) == Approx(h));
  CHECK(run.state.time == Approx(0.025).epsilon(1e-14));
  CHECK(run.step({0, 0.7, 2}) == 0.01);
  run.sizes.stop_at([](double t) { return 0.036 > t ? 0.036 : 1.0; });
  CHECK(run.step({0, 0.7, 2}) == Approx(0.001));
}

TEST_CASE("a step before a corner has the smallest error: it does not shrink the steps behind", "[step_size]") {
  Run run(adaptive(), {0.0101});
  CHECK(run.step({0, 0.7, 2}) == Approx(0.00505));
  CHECK(run.step({0, 0, 2}) == Approx(0.00505));
  CHECK(run.sizes.size() >= 0.01);
}

TEST_CASE("a controller continues from the state of another", "[step_size]") {
  const auto error = [](int i) { return ErrorRatio{0, 0.3 + 0.3 * std::sin(i), 2}; };
  for (const bool adapts : {false, true}) {
    INFO(adapts);
    Run whole(adapts ? adaptive() : constant()), half(adapts ? adaptive() : constant());
    for (Run* run : {&whole, &half}) {
      run->begin();
      run->reject(Rejection::energy_free, 0.5);
      run->reject(Rejection::solve, 0.5);
      run->accept(error(0));
      for (int i = 1; i < 30; ++i) run->step(error(i));
    }
    Run resumed(adapts ? adaptive() : constant());
    resumed.state.time = half.state.time;
    resumed.state.step_size = half.state.step_size;
    for (int i = 30; i < 300; ++i) CHECK(whole.step(error(i)) == resumed.step(error(i)));
    CHECK(whole.state.time == resumed.state.time);
  }
}
