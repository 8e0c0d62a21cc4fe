// Every phase of contact on three plates with 127 000 active contacts, of solids and with friction: what the
// two sheets do not have.
#include "framework/contact/terms/contact_term.hpp"
#include "framework/contact/terms/friction_term.hpp"
#include "framework/core/step_filter.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/exact/intersections.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/support/contact_terms.hpp"

namespace tack::bench {
namespace {

constexpr double h = 0.01;  // s

void plates_broad_phase(benchmark::State& state) {
  const auto scene = plates();
  const ContactSystem& contact = *scene->world->contact;
  size_t candidates = 0;
  for (auto _ : state) {
    BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
    broad_phase.update(scene->world->rest, VecX(), contact.range(), contact.range() / 2);
    candidates = broad_phase.candidates().size();
  }
  state.counters["candidates"] = static_cast<double>(candidates);
}

void plates_begin_step(benchmark::State& state) {
  const auto scene = plates();
  for (auto _ : state) scene->world->contact->begin_step({scene->world->rest});
}

void plates_narrow_phase(benchmark::State& state) {
  const auto scene = plates();
  for (auto _ : state) scene->world->contact->move_to(scene->world->rest);
  state.counters["stencils"] = static_cast<double>(scene->world->contact->contacts().size());
}

void plates_lag_friction(benchmark::State& state) {
  const auto scene = plates();
  scene->world->friction->begin_step({scene->world->rest, 0, h});
  for (auto _ : state) scene->world->friction->lag(scene->world->rest);
}

void plates_value(benchmark::State& state) {
  const auto scene = plates();
  const World& world = *scene->world;
  for (auto _ : state)
    benchmark::DoNotOptimize(contact_term(world).value(world.rest) + world.friction->value(world.rest));
}

void plates_assembled_gradient(benchmark::State& state) {
  const auto scene = plates();
  for (auto _ : state) {
    state.PauseTiming();
    scene->move_to(scene->world->rest);
    state.ResumeTiming();
    benchmark::DoNotOptimize(scene->potential.gradient().data());
  }
}

void plates_assembled_hessian(benchmark::State& state) {
  const auto scene = plates();
  scene->potential.hessian({Projection::clamp});
  for (auto _ : state) benchmark::DoNotOptimize(scene->potential.hessian({Projection::clamp}).values.data());
  state.counters["blocks"] = scene->potential.hessian({Projection::clamp}).blocks();
}

void plates_ccd(benchmark::State& state) {
  const auto scene = plates();
  World& world = *scene->world;
  const auto filter = Registry<StepFilter>::make("ccd");
  filter->attach({world.contact.get(), world.tets, scene->clock});
  const VecX p = random_motion(world.rest.size() / 3, 1e-4);
  double t = filter->largest_step(world.rest, p, 1.0);
  for (auto _ : state) benchmark::DoNotOptimize(t = filter->largest_step(world.rest, p, 1.0));
  state.counters["step"] = t;
}

void plates_exact_check(benchmark::State& state) {
  const auto scene = plates();
  const ContactSystem& contact = *scene->world->contact;
  for (auto _ : state)
    benchmark::DoNotOptimize(find_intersections(contact.surface().mesh, scene->world->rest, contact.colliding(), 1).size());
}

BENCHMARK(plates_broad_phase)->Apply(in_milliseconds);
BENCHMARK(plates_begin_step)->Apply(in_milliseconds);
BENCHMARK(plates_narrow_phase)->Apply(in_milliseconds);
BENCHMARK(plates_lag_friction)->Apply(in_milliseconds);
BENCHMARK(plates_value)->Apply(in_milliseconds);
BENCHMARK(plates_assembled_gradient)->Apply(in_milliseconds);
BENCHMARK(plates_assembled_hessian)->Apply(in_milliseconds);
BENCHMARK(plates_ccd)->Apply(in_milliseconds);
BENCHMARK(plates_exact_check)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
