// Motions that go along with what another object does: kinematic chains.
#pragma once

#include <memory>
#include <string>

#include "framework/motion/motion.hpp"
#include "framework/scene/scene_config.hpp"

namespace tack {

// The motion of `object` as it is in space; null if nothing carries it. `name` is for messages.
// Throws InputError if the object is not there, is carried by itself in the end, or has no one motion that holds all of it rigidly while
// the carried one lasts.
std::unique_ptr<Motion> carried_motion(const Motion& motion, const std::string& name, const std::string& object, const SceneConfig& scene);

}  // namespace tack
