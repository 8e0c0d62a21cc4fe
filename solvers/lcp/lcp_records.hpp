// What results show of contact where it is constraints: forces are impulses over the step, in the place of those of the barrier and of
// friction's potential, which store nothing.
#pragma once

#include <memory>

#include "framework/world/world.hpp"
#include "solvers/lcp/lcp_step.hpp"

namespace tack {

void publish_impulses(World& world, std::shared_ptr<const LcpStep> step);

}  // namespace tack
