// Candidate search on the two sheets: a first build, a rebuild in refitted trees, and the check that
// lets a list of candidates be used again.
#include "framework/contact/contact_system.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

constexpr double range = 2e-3;  // m

// skin 0: the pairs that other programs search; skin = range: as in a run.
double skin_of(const benchmark::State& state) { return state.range(0) ? range : 0.0; }

void broad_phase_build(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  const ContactSystem& contact = *scene->world->contact;
  size_t candidates = 0;
  for (auto _ : state) {
    BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
    broad_phase.update(scene->world->rest, VecX(), range, skin_of(state));
    candidates = broad_phase.candidates().size();
  }
  state.counters["candidates"] = static_cast<double>(candidates);
}
BENCHMARK(broad_phase_build)->ArgName("skin")->Arg(0)->Arg(1)->Apply(in_milliseconds);

// Alternates between two configurations so far apart that each update searches again.
void broad_phase_rebuild(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  const ContactSystem& contact = *scene->world->contact;
  BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
  const VecX here = scene->world->rest;
  const VecX there = here + VecX::Constant(here.size(), 3 * range);
  bool back = false;
  broad_phase.update(here, VecX(), range, skin_of(state));
  const int before = broad_phase.builds();
  for (auto _ : state) broad_phase.update((back = !back) ? there : here, VecX(), range, skin_of(state));
  state.counters["builds"] = benchmark::Counter(broad_phase.builds() - before,
                                                benchmark::Counter::kAvgIterations);
}
BENCHMARK(broad_phase_rebuild)->ArgName("skin")->Arg(0)->Arg(1)->Apply(in_milliseconds);

void broad_phase_still_covered(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  const ContactSystem& contact = *scene->world->contact;
  BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
  broad_phase.update(scene->world->rest, VecX(), range, range);
  for (auto _ : state)
    benchmark::DoNotOptimize(broad_phase.update(scene->world->rest, VecX(), range, range));
}
BENCHMARK(broad_phase_still_covered)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
