// The contact potential of the two sheets: stencils alone, and the Hessian assembled with its
// gather maps. Cases: plain sums of pairs or area weights, barrier alone or with adhesion.
#include "framework/contact/terms/contact_term.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/support/contact_terms.hpp"

namespace tack::bench {
namespace {

void cases(benchmark::internal::Benchmark* b) {
  in_milliseconds(b);
  b->ArgNames({"pair_sums", "adhesion"});
  for (const int pair : {0, 1})
    for (const int adhesion : {0, 1}) b->Args({pair, adhesion});
}

std::unique_ptr<Scene> scene_of(const benchmark::State& state) {
  return sheets(state.range(0) ? "pair" : "area",
                state.range(1) ? Laws::barrier_and_adhesion : Laws::barrier);
}

// Slots of a term's stencils.
struct Slots {
  explicit Slots(const Term& term) {
    size_t vertices = 0, blocks = 0;
    for (const StencilBatch& batch : term.batches()) {
      vertices += static_cast<size_t>(batch.arity) * batch.count;
      blocks += static_cast<size_t>(hessian_blocks(batch.arity)) * batch.count;
      stencils += batch.count;
    }
    gradient.resize(3 * vertices);
    hessian.resize(9 * blocks);
  }
  std::vector<double> gradient, hessian;
  int stencils = 0;
};

void contact_value(benchmark::State& state) {
  const auto scene = scene_of(state);
  const World& world = *scene->world;
  for (auto _ : state) benchmark::DoNotOptimize(contact_term(world).value(world.rest));
  state.counters["stencils"] = static_cast<double>(world.contact->contacts().size());
}
BENCHMARK(contact_value)->Apply(cases);

void contact_gradient(benchmark::State& state) {
  const auto scene = scene_of(state);
  const World& world = *scene->world;
  Slots slots(contact_term(world));
  for (auto _ : state)
    contact_term(world).derivatives(world.rest, Projection::none, slots.gradient.data(), nullptr);
}
BENCHMARK(contact_gradient)->Apply(cases);

void hessian(benchmark::State& state, Projection projection) {
  const auto scene = scene_of(state);
  const World& world = *scene->world;
  Slots slots(contact_term(world));
  for (auto _ : state)
    contact_term(world).derivatives(world.rest, projection, slots.gradient.data(), slots.hessian.data());
  state.counters["per_stencil"] =
      benchmark::Counter(slots.stencils, benchmark::Counter::kIsIterationInvariantRate |
                                             benchmark::Counter::kInvert);
}
void contact_hessian(benchmark::State& state) { hessian(state, Projection::none); }
void contact_hessian_clamped(benchmark::State& state) { hessian(state, Projection::clamp); }
BENCHMARK(contact_hessian)->Apply(cases);
BENCHMARK(contact_hessian_clamped)->Apply(cases);

void assembled(benchmark::State& state, Projection projection) {
  const auto scene = scene_of(state);
  scene->potential.hessian({projection});
  for (auto _ : state) benchmark::DoNotOptimize(scene->potential.hessian({projection}).values.data());
  state.counters["blocks"] = scene->potential.hessian({projection}).blocks();
}
void contact_assembled_hessian(benchmark::State& state) { assembled(state, Projection::none); }
void contact_assembled_hessian_clamped(benchmark::State& state) { assembled(state, Projection::clamp); }
BENCHMARK(contact_assembled_hessian)->Apply(cases);
BENCHMARK(contact_assembled_hessian_clamped)->Apply(cases);

void contact_assembled_gradient(benchmark::State& state) {
  const auto scene = scene_of(state);
  for (auto _ : state) {
    state.PauseTiming();
    scene->move_to(scene->world->rest);
    state.ResumeTiming();
    benchmark::DoNotOptimize(scene->potential.gradient().data());
  }
}
BENCHMARK(contact_assembled_gradient)->Apply(cases);

}  // namespace
}  // namespace tack::bench
