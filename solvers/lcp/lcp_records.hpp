// Records of contact by constraints: forces are impulses over the step. They replace those of the
// barrier and of the friction potential, which store nothing here.
#pragma once

#include <memory>

#include "framework/world/world.hpp"
#include "solvers/lcp/lcp_step.hpp"

namespace tack {

void publish_impulses(World& world, std::shared_ptr<const LcpStep> step);

}  // namespace tack
