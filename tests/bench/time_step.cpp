// Whole runs of experiments, nothing written: seconds per step and Newton iteration, the share of each phase and
// the most memory, as counters and in one table at the end. The groups: `run` the experiments as they stand,
// `cells` meshes with 1, 2, 4, 8 (and 27) times the vertices, `linear` each linear solver.
#include <fmt/format.h>

#include <string>
#include <vector>

#include "framework/core/linear_solver.hpp"
#include "framework/run/simulation.hpp"
#include "tests/bench/memory_peak.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

struct Totals {
  int steps = 0, iterations = 0;
  double seconds = 0;
  double megabytes = 0;  // the most memory, that of the program included
  PhaseClock::Seconds phases{};
};

Totals run(Simulation& simulation, int steps) {
  simulation.start();
  Totals totals;
  while (!simulation.finished() && totals.steps < steps) {
    const StepReport report = simulation.step();
    ++totals.steps;
    totals.iterations += report.solve.iterations;
    totals.seconds += report.wall_seconds;
    for (int i = 0; i < phase_count; ++i) totals.phases[i] += report.phases[i];
  }
  return totals;
}

struct Row {
  std::string name;
  Eigen::Index unknowns;
  Totals totals;
};
std::vector<Row>& table() {
  static std::vector<Row> rows;
  return rows;
}

struct Run {
  std::string name, file;  // in experiments/
  std::vector<std::string> overrides = {};
  int steps = 1 << 30;
};

// One run per repetition: a second one in the same world would start with a factor of the first.
void measure(benchmark::State& state, const Run& r) {
  MemoryPeak peak;
  Simulation simulation(loaded(r.file, r.overrides));
  Totals totals;
  for (auto _ : state) {
    totals = run(simulation, r.steps);
    state.SetIterationTime(totals.seconds);
  }
  totals.megabytes = peak.megabytes();
  state.counters["s_per_step"] = totals.seconds / totals.steps;
  state.counters["s_per_newton"] = totals.seconds / totals.iterations;
  state.counters["newton_per_step"] = static_cast<double>(totals.iterations) / totals.steps;
  state.counters["MB"] = totals.megabytes;
  for (int i = 0; i < phase_count; ++i)
    if (totals.phases[i] > 0)
      state.counters["%" + std::string(phase_names[i])] = 100 * totals.phases[i] / totals.seconds;
  table().push_back({r.name, simulation.world().dofs.size(), totals});
}

std::vector<Run> runs() {
  std::vector<Run> runs;
  for (const char* file : {"debonding/pull", "stack/two_blocks", "stack/tower", "stack/pile", "slope/slide", "shear/both",
                           "wall_cube/detaches", "arch/stands", "squash/block", "squash/six_blocks", "twist/mat",
                           "twist/cloth_as_tets"})
    runs.push_back({"run/" + std::string(file), std::string(file) + ".yaml"});
  for (const int n : {39, 55, 79, 111})
    runs.push_back({fmt::format("cells/twist/{}", n), "twist/mat.yaml",
                    {fmt::format("objects.mat.shape.cells=[{},1,{}]", n, n)}, 20});
  for (const int n : {9, 12, 15, 19, 29})
    runs.push_back({fmt::format("cells/two_blocks/{}", n), "stack/two_blocks.yaml",
                    {fmt::format("objects.lower.shape.cells=[{},{},{}]", n, n, n),
                     fmt::format("objects.upper.shape.cells=[{},{},{}]", n, n, n)}});
  for (const std::string& linear : Registry<LinearSolver>::kind().names())
    runs.push_back({"linear/two_blocks/" + linear, "stack/two_blocks.yaml", {"solver.linear=" + linear}});
  return runs;
}

}  // namespace

void add_runs() {
  for (const Run& r : runs())
    benchmark::RegisterBenchmark(r.name.c_str(), [r](benchmark::State& state) { measure(state, r); })
        ->Iterations(1)->UseManualTime()->Unit(benchmark::kSecond);
}

void print_runs(std::FILE* out) {
  if (table().empty()) return;
  fmt::print(out, "\n{:26}{:>9}{:>7}{:>8}{:>9}{:>9}{:>8}", "percent of a run", "unknowns", "steps", "it/step", "ms/step",
             "ms/it", "MB");
  for (const auto& phase : phase_names) fmt::print(out, "{:>14}", phase);
  fmt::print(out, "\n");
  for (const Row& row : table()) {
    const Totals& t = row.totals;
    fmt::print(out, "{:26}{:9}{:7}{:8.2f}{:9.2f}{:9.2f}{:8.0f}", row.name, row.unknowns, t.steps,
               double(t.iterations) / t.steps, 1e3 * t.seconds / t.steps, 1e3 * t.seconds / t.iterations, t.megabytes);
    for (const double seconds : t.phases) fmt::print(out, "{:14.1f}", 100 * seconds / t.seconds);
    fmt::print(out, "\n");
  }
}

}  // namespace tack::bench
