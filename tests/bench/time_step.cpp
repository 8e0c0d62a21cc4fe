// The whole of experiments/stack/two_blocks.yaml, 60 steps, nothing written: seconds per step and per
// Newton iteration, and the share of each phase.
#include <chrono>
#include <string>

#include "framework/stepping/time_stepper.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

struct Totals {
  int steps = 0, iterations = 0;
  double seconds = 0;
  PhaseClock::Seconds phases{};
};

Totals run_to_end(Scene& scene) {
  TimeStepper stepper(*scene.world, scene.loaded.config, scene.clock, [](const std::string&) {});
  Totals totals;
  while (!stepper.finished()) {
    const StepReport report = stepper.advance();
    ++totals.steps;
    totals.iterations += report.solve.iterations;
    totals.seconds += report.wall_seconds;
    for (int i = 0; i < phase_count; ++i) totals.phases[i] += report.phases[i];
  }
  return totals;
}

// One run per repetition: a second one in the same world would start with a factor of the first.
void two_blocks_run(benchmark::State& state, const char* linear) {
  const auto scene = two_blocks(linear);
  Totals totals;
  for (auto _ : state) {
    totals = run_to_end(*scene);
    state.SetIterationTime(totals.seconds);
  }
  state.counters["s_per_step"] = totals.seconds / totals.steps;
  state.counters["s_per_newton"] = totals.seconds / totals.iterations;
  state.counters["newton_per_step"] = static_cast<double>(totals.iterations) / totals.steps;
  for (int i = 0; i < phase_count; ++i)
    if (totals.phases[i] > 0)
      state.counters["%" + std::string(phase_names[i])] = 100 * totals.phases[i] / totals.seconds;
}
void one_run(benchmark::internal::Benchmark* b) {
  b->Iterations(1)->UseManualTime()->Unit(benchmark::kSecond);
}
BENCHMARK_CAPTURE(two_blocks_run, as_it_stands, "")->Apply(one_run);
BENCHMARK_CAPTURE(two_blocks_run, cholmod, "cholmod")->Apply(one_run);
BENCHMARK_CAPTURE(two_blocks_run, lagged_cholesky, "lagged_cholesky")->Apply(one_run);

}  // namespace
}  // namespace tack::bench
