// Candidates among 500 grains of rice that only touch each other and stick to one ball (experiments/meatball/paper.yaml).
#include "framework/contact/contact_system.hpp"
#include "framework/contact/surface/pair_radii.hpp"
#include "geometry/broad_phase/broad_phase.hpp"

#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

constexpr double way = 1e-3;  // m, of a vertex in a step

std::unique_ptr<Scene> rice() { return std::make_unique<Scene>(loaded("meatball/paper.yaml")); }

// own 0: every object reaches half of the largest range; 1: as far as its own pairs do, as in a run.
InflationRadii radii_of(const ContactSystem& contact, const benchmark::State& state) {
  if (state.range(0) != 0) return pair_radii(contact.surface(), contact.pairs());
  return InflationRadii::uniform(contact.surface().mesh, contact.range(), contact.pairs().largest_edge_range());
}

void rice_candidates(benchmark::State& state) {
  const auto scene = rice();
  const ContactSystem& contact = *scene->world->contact;
  const InflationRadii radii = radii_of(contact, state);
  const VecX p = random_motion(scene->world->rest.size() / 3, way);
  size_t candidates = 0;
  for (auto _ : state) {
    BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
    broad_phase.update(scene->world->rest, p, radii, 0.5 * contact.range());
    candidates = broad_phase.candidates().size();
  }
  state.counters["candidates"] = static_cast<double>(candidates);
}
BENCHMARK(rice_candidates)->ArgName("own")->Arg(0)->Arg(1)->Apply(in_milliseconds);

// Every tenth object goes away and comes back; the others stay, and are not searched again.
void rice_some_candidates(benchmark::State& state) {
  const auto scene = rice();
  const ContactSystem& contact = *scene->world->contact;
  const InflationRadii radii = radii_of(contact, state);
  const VecX here = scene->world->rest;
  VecX there = here;
  for (const int v : contact.surface().mesh.vertices)
    if (contact.surface().mesh.vertex_object[v] % 10 == 7) vertex(there, v).array() += 2 * contact.range();
  BroadPhase broad_phase(contact.surface().mesh, contact.colliding());
  broad_phase.update(here, VecX(), radii, 0.5 * contact.range());
  bool back = false;
  for (auto _ : state) broad_phase.update((back = !back) ? there : here, VecX(), radii, 0.5 * contact.range());
  state.counters["candidates"] = static_cast<double>(broad_phase.candidates().size());
}
BENCHMARK(rice_some_candidates)->ArgName("own")->Arg(0)->Arg(1)->Apply(in_milliseconds);

// Contacts, candidates included, where one object in a hundred goes away and comes back within a step. all 1: so does a vertex of the pan's rim, which is
// fixed, so that all are searched and evaluated again.
void rice_some_contacts(benchmark::State& state) {
  const auto scene = rice();
  ContactSystem& contact = *scene->world->contact;
  const Body& pan = scene->world->bodies[scene->world->body_index("pan")];
  const VecX here = scene->world->rest;
  VecX there = here;
  for (const int v : contact.surface().mesh.vertices)
    if (contact.surface().mesh.vertex_object[v] % 100 == 7) vertex(there, v).array() += 2 * contact.range();
  if (state.range(0) != 0) vertex(there, pan.first_vertex + pan.vertex_count - 1).array() += 4 * contact.range();
  contact.begin_step({here});
  bool back = false;
  for (auto _ : state) contact.move_to((back = !back) ? there : here);
  state.counters["candidates"] = static_cast<double>(contact.candidates().size());
}
BENCHMARK(rice_some_contacts)->ArgName("all")->Arg(0)->Arg(1)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
