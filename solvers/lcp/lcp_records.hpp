// Results of contact for the constraint-based integrator: contact and friction forces are impulses
// divided by the step. They replace the forces of the barrier and of the friction potential;
// constraints store no energy.
#pragma once

#include <memory>

#include "framework/world/world.hpp"
#include "solvers/lcp/lcp_step.hpp"

namespace tack {

void publish_impulses(World& world, std::shared_ptr<const LcpStep> step);

}  // namespace tack
