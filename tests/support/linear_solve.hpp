// One linear system, by a solver as a scene describes it.
#pragma once

#include <catch2/catch.hpp>

#include "framework/core/linear_solver.hpp"
#include "tests/support/component_variants.hpp"

namespace tack {

struct Solved {
  VecX x;
  int iterations;
};

inline Solved solve(const std::string& yaml, const BlockMatrix& matrix, const VecX& b) {
  const auto solver = component<LinearSolver>(yaml);
  PhaseClock clock;
  REQUIRE(solver->factorize(matrix, clock));
  VecX x;
  solver->solve(b, x, clock);
  return {x, solver->iterations()};
}

}  // namespace tack
