// Motions relative to the motion of another object: kinematic chains.
#pragma once

#include <memory>
#include <string>

#include "framework/motion/motion.hpp"
#include "framework/scene/scene_config.hpp"

namespace tack {

// Returns the motion of `object` in space; null if its motion has no carrier. name: for messages.
// Throws InputError if the carrier does not exist, if carriers form a cycle, or if the carrier has
// no single rigid motion of all its vertices for as long as the relative motion lasts.
std::unique_ptr<Motion> relative_motion(const Motion& motion, const std::string& name,
                                        const std::string& object, const SceneConfig& scene);

}  // namespace tack
