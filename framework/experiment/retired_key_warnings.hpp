// Warnings about keys of a scene that have been renamed (config/retired_keys.hpp).
#pragma once

#include <vector>

#include "framework/core/warning.hpp"
#include "framework/experiment/experiment.hpp"

namespace tack {

// Returns one warning per retired key. root: the scene as parsed; experiment: bound to it.
std::vector<Warning> retired_key_warnings(const Value& root, const Experiment& experiment);

}  // namespace tack
