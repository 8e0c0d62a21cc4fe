// Benchmarks of every phase of a run. `./tack bench` runs them; docs/performance.md explains how the
// figures are measured. Benchmarks of registered components are added after the static initialisers.
#include <benchmark/benchmark.h>

#include "tests/bench/registered.hpp"

int main(int argc, char** argv) {
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  tack::bench::add_solid_energies();
  tack::bench::add_scalar_laws();
  tack::bench::add_linear_solvers();
  tack::bench::add_runs();
  benchmark::RunSpecifiedBenchmarks();
  tack::bench::print_runs(stderr);
  benchmark::Shutdown();
  return 0;
}
