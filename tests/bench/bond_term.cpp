// The potential of bonds, of the two sheets: as many bonds, per stencil, as contacts that adhere by a law of the gap.
#include "framework/bond/bond_term.hpp"
#include "framework/contact/terms/contact_term.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"
#include "tests/support/contact_terms.hpp"

namespace tack::bench {
namespace {

// The Hessians of a term's stencils, clamped, whose vertices have moved by up to a third of the opening at which bonds fail.
void per_stencil(benchmark::State& state, const Scene& scene, const Term& term) {
  const VecX x = scene.world->rest + random_motion(scene.world->rest.size() / 3, 5e-5);
  size_t vertices = 0, blocks = 0;
  int stencils = 0;
  for (const StencilBatch& batch : term.batches()) {
    vertices += static_cast<size_t>(batch.arity) * batch.count;
    blocks += static_cast<size_t>(hessian_blocks(batch.arity)) * batch.count;
    stencils += batch.count;
  }
  std::vector<double> gradient(3 * vertices), hessian(9 * blocks);
  for (auto _ : state) term.derivatives(x, Projection::clamp, gradient.data(), hessian.data());
  state.counters["stencils"] = stencils;
  state.counters["per_stencil"] =
      benchmark::Counter(stencils, benchmark::Counter::kIsIterationInvariantRate | benchmark::Counter::kInvert);
}

void bonds_hessian_clamped(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_bonds);
  per_stencil(state, *scene, *scene->world->bonds);
}
void adhesion_hessian_clamped(benchmark::State& state) {
  const auto scene = sheets("area", Laws::barrier_and_adhesion);
  per_stencil(state, *scene, contact_term(*scene->world));
}
BENCHMARK(bonds_hessian_clamped)->Apply(in_milliseconds);
BENCHMARK(adhesion_hessian_clamped)->Apply(in_milliseconds);

}  // namespace
}  // namespace tack::bench
