// Benchmarks of all registered components of a kind: a new component is measured because it exists.
// Called by main(), when the registries are complete.
#pragma once

#include <benchmark/benchmark.h>

namespace tack::bench {

void add_solid_energies();
void add_scalar_laws();
void add_linear_solvers();

// Wall time in milliseconds: the phases are parallel.
inline void in_milliseconds(benchmark::internal::Benchmark* b) {
  b->Unit(benchmark::kMillisecond)->UseRealTime();
}

}  // namespace tack::bench
