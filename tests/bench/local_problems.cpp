// Local problems of 10, 100 and 1000 vertices around a contact, among 101 000 of two blocks: making
// one, and its value, derivatives and feasible step; beside them the whole problem.
#include <algorithm>

#include "framework/stepping/feasible_steps.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

std::unique_ptr<Scene> large_blocks() {
  return std::make_unique<Scene>(loaded("stack/two_blocks.yaml", {"objects.lower.shape.cells=[36, 36, 36]", "objects.upper.shape.cells=[36, 36, 36]",
                                                                  "objects.lower.place.translate=[0, 0.1005, 0]", "objects.upper.place.translate=[0.013, 0.301, 0.007]"}));
}

// The blocks that are nearest to the middle of the contact.
std::vector<int> region(const Scene& scene, size_t count) {
  const DofMap& dofs = scene.world->dofs;
  const VecX& x = scene.step.state.x;
  std::vector<std::pair<double, int>> all;
  for (int b = 0; b < dofs.block_count(); ++b) all.emplace_back((Vec3(vertex(x, dofs.vertex_of_block(b))) - Vec3(0, 0.2, 0)).norm(), b);
  std::sort(all.begin(), all.end());
  std::vector<int> blocks;
  for (size_t i = 0; i < std::min(count, all.size()); ++i) blocks.push_back(all[i].second);
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

struct Local {
  explicit Local(size_t count) : scene(large_blocks()), blocks(region(*scene, count)), steps(*scene->world, scene->clock), problem{scene->potential, {}, {}, scene->clock} {
    scene->move_to(scene->step.state.x);
    steps.set_feasibility(scene->potential, problem);
    problem.local(blocks);  // makes the maps
  }
  std::unique_ptr<Scene> scene;
  std::vector<int> blocks;
  FeasibleSteps steps;
  MinimizerProblem problem;
};

void local_make(benchmark::State& state) {
  const Local local(static_cast<size_t>(state.range(0)));
  for (auto _ : state) benchmark::DoNotOptimize(local.problem.local(local.blocks).objective->size());
}

void local_value(benchmark::State& state) {
  const Local local(static_cast<size_t>(state.range(0)));
  const LocalProblem problem = local.problem.local(local.blocks);
  for (auto _ : state) {
    problem.objective->move_to(problem.q);
    benchmark::DoNotOptimize(problem.objective->value());
  }
}

void local_hessian(benchmark::State& state) {
  const Local local(static_cast<size_t>(state.range(0)));
  const LocalProblem problem = local.problem.local(local.blocks);
  for (auto _ : state) {
    problem.objective->move_to(problem.q);
    benchmark::DoNotOptimize(problem.objective->hessian({Projection::clamp}).values.data());
  }
}

void local_step(benchmark::State& state) {
  const Local local(static_cast<size_t>(state.range(0)));
  const LocalProblem problem = local.problem.local(local.blocks);
  const VecX p = random_motion(problem.q.size() / 3, 1e-4);
  for (auto _ : state) benchmark::DoNotOptimize(problem.feasible_step(problem.q, p));
}

void whole_hessian(benchmark::State& state) {
  const Local local(10);
  VecX q;
  local.scene->world->dofs.gather(local.scene->step.state.x, q);
  for (auto _ : state) {
    local.scene->potential.move_to(q);
    benchmark::DoNotOptimize(local.scene->potential.hessian({Projection::clamp}).values.data());
  }
}

void regions(benchmark::internal::Benchmark* b) { b->ArgName("blocks")->Arg(10)->Arg(100)->Arg(1000)->Unit(benchmark::kMicrosecond); }
BENCHMARK(local_make)->Apply(regions);
BENCHMARK(local_value)->Apply(regions);
BENCHMARK(local_hessian)->Apply(regions);
BENCHMARK(local_step)->Apply(regions);
BENCHMARK(whole_hessian)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace tack::bench
