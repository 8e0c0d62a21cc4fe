// The largest feasible step: CCD of the two sheets for a large and a small random motion, inversion of
// the tets of the two blocks. Candidates are found before the clock starts.
#include "framework/contact/contact_system.hpp"
#include "framework/core/step_filter.hpp"

#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

void step_filter(benchmark::State& state, const char* name, Scene& scene, double half_width) {
  World& world = *scene.world;
  const auto filter = Registry<StepFilter>::make(name);
  if (!filter->attach({world.contact.get(), world.tets, scene.clock})) {
    state.SkipWithError("nothing to watch");
    return;
  }
  const VecX p = random_motion(world.rest.size() / 3, half_width);
  double t = filter->largest_step(world.rest, p, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(t = filter->largest_step(world.rest, p, 1.0));
  state.counters["step"] = t;
  if (world.contact) state.counters["candidates"] = static_cast<double>(world.contact->candidates().size());
}

void ccd_sheets(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  step_filter(state, "ccd", *scene, 1e-6 * static_cast<double>(state.range(0)));
}
BENCHMARK(ccd_sheets)->ArgName("micrometres")->Arg(100)->Arg(10000)->Apply(in_milliseconds);

void inversion_blocks(benchmark::State& state) {
  const auto scene = two_blocks();
  step_filter(state, "inversion", *scene, 1e-3);
}
BENCHMARK(inversion_blocks)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
