// Every registered linear solver on Newton systems of the two blocks in contact. The systems are those
// of two neighbouring time steps in turn, so that a solver that reuses an old factor has to work for it.
#include <fmt/format.h>

#include "framework/core/linear_solver.hpp"
#include "framework/run/simulation.hpp"
#include "tests/bench/registered.hpp"
#include "tests/bench/scenes.hpp"

namespace tack::bench {
namespace {

struct Systems {
  std::array<BlockMatrix, 2> matrix;
  std::array<VecX, 2> right_side;
};

std::array<VecX, 2> neighbouring_states() {
  constexpr int steps = 30;  // both blocks have landed
  Simulation simulation(loaded("stack/two_blocks.yaml"));
  simulation.start();
  for (int s = 0; s < steps; ++s) simulation.step();
  const VecX before = simulation.state().x;
  simulation.step();
  return {before, simulation.state().x};
}

// Built once, so that all solvers get equal systems.
const Systems& systems() {
  static const Systems made = [] {
    const auto scene = two_blocks();
    const auto states = neighbouring_states();
    Systems s;
    // The pattern grows to hold both states; only then both matrices have one pattern.
    for (int round = 0; round < 2; ++round) {
      for (int i = 0; i < 2; ++i) {
        scene->move_to(states[i]);
        s.matrix[i] = scene->potential.hessian({Projection::clamp});
        s.right_side[i] = -scene->potential.gradient();
      }
    }
    return s;
  }();
  return made;
}

void first_factorization(benchmark::State& state, const std::string& name) {
  const Systems& s = systems();
  PhaseClock clock;
  for (auto _ : state) {
    const auto solver = Registry<LinearSolver>::make(name);
    if (!solver->factorize(s.matrix[0], clock)) state.SkipWithError("not positive definite");
  }
  state.counters["unknowns"] = s.matrix[0].size();
}

void factorize_and_solve(benchmark::State& state, const std::string& name) {
  const Systems& s = systems();
  PhaseClock clock;
  const auto solver = Registry<LinearSolver>::make(name);
  VecX x;
  int i = 0;
  const auto turn = [&] {
    if (!solver->factorize(s.matrix[i], clock)) state.SkipWithError("not positive definite");
    solver->solve(s.right_side[i], x, clock);
    i = 1 - i;
  };
  turn();
  for (auto _ : state) turn();
  if (i == 1) turn();  // x is that of the second system, which is not the one of the first factor
  VecX product;
  s.matrix[1].multiply(x, product);
  state.counters["residual"] = (product - s.right_side[1]).norm() / s.right_side[1].norm();
}

void solve_only(benchmark::State& state, const std::string& name) {
  const Systems& s = systems();
  PhaseClock clock;
  const auto solver = Registry<LinearSolver>::make(name);
  if (!solver->factorize(s.matrix[0], clock)) state.SkipWithError("not positive definite");
  VecX x;
  for (auto _ : state) solver->solve(s.right_side[0], x, clock);
}

}  // namespace

void add_linear_solvers() {
  using Run = void (*)(benchmark::State&, const std::string&);
  for (const std::string& name : Registry<LinearSolver>::kind().names())
    for (const auto& [suffix, run] :
         {std::pair<const char*, Run>{"first_factorization", first_factorization},
          {"factorize_and_solve", factorize_and_solve},
          {"solve_again", solve_only}}) {
      in_milliseconds(benchmark::RegisterBenchmark(
          fmt::format("{}/{}", name, suffix).c_str(),
          [name, run = run](benchmark::State& state) { run(state, name); }));
    }
}

}  // namespace tack::bench
