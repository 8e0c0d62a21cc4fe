// The scenes that benchmarks measure. Build one per benchmark, outside the timed loop.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/run/simulation.hpp"

namespace tack::bench {

// A world about to take its first step: everything is at its start.
struct Scene {
  explicit Scene(LoadedExperiment loaded);
  void move_to(const VecX& x);  // the potential and all participants

  Simulation simulation;
  World* const world = &simulation.world();
  PhaseClock& clock = simulation.clock();
  const Step step;
  StepPotential& potential = step.potential;  // of all terms
};

enum class Laws { barrier, barrier_and_adhesion, barrier_and_bonds };

// Two open sheets of 100x100 vertices, 1 m, diagonals alternating; the upper one 0.25 mm above the
// lower one and turned by 7 degrees in its plane. dhat_b = dhat_p = 1 mm, dhat_a = 2 mm. No elastic
// energy, contact only: 0.1 g per vertex. Bonds: 58 000, three a triangle. weights: "area" or
// "pair".
std::unique_ptr<Scene> sheets(const std::string& weights, Laws laws);

// Three plates of 1 x 0.01 x 1 m, 75x1x75 cells each, above each other with gaps of 0.25 mm and
// turned by 0, 7 and 14 degrees in their plane; the lowest is fixed. dhat_b = 1 mm, friction of
// 0.5. 127 000 active contacts.
std::unique_ptr<Scene> plates();

// A file in experiments/, without frames. Overrides: "a.b=c".
LoadedExperiment loaded(const std::string& file, std::vector<std::string> overrides = {});
std::unique_ptr<Scene> two_blocks();

// A repeatable displacement of n vertices, uniform in a cube of the given half width [m].
VecX random_motion(Eigen::Index vertices, double half_width);

}  // namespace tack::bench
