// Active stencils of the two sheets from given candidates.
#include "framework/contact/contact_system.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

void count_stencils(const ContactSet& contacts, benchmark::State& state) {
  state.counters["pp"] = static_cast<double>(contacts.point_point.size());
  state.counters["pe"] = static_cast<double>(contacts.point_edge.size());
  state.counters["pt"] = static_cast<double>(contacts.point_triangle.size());
  state.counters["ee"] = static_cast<double>(contacts.edge_edge.size());
}

void narrow_phase(benchmark::State& state) {
  const auto scene = sheets(state.range(0) ? "pair" : "area", Laws::barrier_and_adhesion);
  ContactSystem& contact = *scene->world->contact;
  for (auto _ : state) contact.move_to(scene->world->rest);
  count_stencils(contact.contacts(), state);
}
BENCHMARK(narrow_phase)->ArgName("pair_sums")->Arg(0)->Arg(1)->Apply(in_milliseconds);

void narrow_phase_begin_step(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  for (auto _ : state) scene->world->contact->begin_step({scene->world->rest});
}
BENCHMARK(narrow_phase_begin_step)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
