// The scenes that benchmarks measure. Build one per benchmark, outside the timed loop.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/assembly/incremental_potential.hpp"
#include "framework/experiment/built_experiment.hpp"

namespace tack::bench {

// A world and what it refers to.
struct Scene {
  std::unique_ptr<BuiltExperiment> built;  // null for sheets
  LoadedExperiment loaded = {};            // of sheets
  std::unique_ptr<World> own_world;
  PhaseClock own_clock = {};
  World* world = built ? &built->world() : own_world.get();
  PhaseClock& clock = built ? built->clock() : own_clock;
};

enum class Laws { barrier, barrier_and_adhesion };

// Two open sheets of 100x100 vertices, 1 m, diagonals alternating; the upper one 0.25 mm above the
// lower one and turned by 7 degrees in its plane. dhat_b = dhat_p = 1 mm, dhat_a = 2 mm. No elastic
// energy, contact only. weights: "area" or "pair".
std::unique_ptr<Scene> sheets(const std::string& weights, Laws laws);

// Three plates of 1 x 0.01 x 1 m, 75x1x75 cells each, above each other with gaps of 0.25 mm and turned by 0, 7 and
// 14 degrees in their plane; the lowest is fixed. dhat_b = 1 mm, friction of 0.5. 127 000 active contacts.
std::unique_ptr<Scene> plates();

// A file in experiments/, without frames. Overrides: "a.b=c".
LoadedExperiment loaded(const std::string& file, std::vector<std::string> overrides = {});
std::unique_ptr<Scene> two_blocks();

// The potential of all terms of a scene, at rest: one step of 0.01 s about to start.
class StepPotential {
 public:
  explicit StepPotential(Scene& scene);
  IncrementalPotential& operator*() { return potential_; }
  IncrementalPotential* operator->() { return &potential_; }
  void move_to(const VecX& x);

 private:
  World& world_;
  IncrementalPotential potential_;
};

// A repeatable displacement of n vertices, uniform in a cube of the given half width [m].
VecX random_motion(Eigen::Index vertices, double half_width);

}  // namespace tack::bench
