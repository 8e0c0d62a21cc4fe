// Messages about the obstacle that stopped a step or a vertex with prescribed motion.
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "framework/core/step_filter.hpp"
#include "framework/world/world.hpp"

namespace tack {

// Returns "the prescribed motion drives 'plate' into 'block': vertex 3 of 'plate' is still 0.002 m
// short of its target". x: 3n; v: the vertex (global); distance: to its target position [m].
std::string describe_obstacle(const World& world, const VecX& x, int v, double distance);

// Describes the tightest bound of the step from x to x + p (3n): "cut to 0.03 of its length by
// vertex 3 of 'plate' and triangle (1, 2, 5) of 'ball', 2e-06 m apart"; "" if the full step is
// feasible.
std::string describe_blocker(const World& world,
                             const std::vector<std::unique_ptr<StepFilter>>& filters, const VecX& x,
                             const VecX& p);

}  // namespace tack
