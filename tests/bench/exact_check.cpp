// The independent check of an accepted state: exact intersections and exact orientations.
#include "framework/contact/contact_system.hpp"
#include "geometry/exact/intersections.hpp"
#include "geometry/exact/orientation.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

void intersections(benchmark::State& state, const Scene& scene) {
  const ContactSystem& contact = *scene.world->contact;
  size_t hits = 0;
  for (auto _ : state)
    hits += find_intersections(contact.surface().mesh, scene.world->rest, contact.colliding(), 1).size();
  if (hits > 0) state.SkipWithError("the scene intersects");
}

void exact_check_sheets(benchmark::State& state) {
  intersections(state, *sheets("area", Laws::barrier_and_adhesion));
}
void exact_check_blocks(benchmark::State& state) { intersections(state, *two_blocks()); }
void exact_orientation_blocks(benchmark::State& state) {
  const auto scene = two_blocks();
  for (auto _ : state)
    benchmark::DoNotOptimize(first_inverted_tet(scene->world->tets, scene->world->rest));
}
BENCHMARK(exact_check_sheets)->Apply(in_milliseconds);
BENCHMARK(exact_check_blocks)->Apply(in_milliseconds);
BENCHMARK(exact_orientation_blocks)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
