// Benchmarks of all registered components of a kind: a new component is measured because it exists;
// and whole runs.
// Called by main(), when the registries are complete.
#pragma once

#include <benchmark/benchmark.h>

#include <cstdio>

namespace tack::bench {

void add_solid_energies();
void add_scalar_laws();
void add_linear_solvers();
void add_runs();
void print_runs(std::FILE* out);  // the table of the runs that were measured

// Wall time in milliseconds: the phases are parallel.
inline void in_milliseconds(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace tack::bench
