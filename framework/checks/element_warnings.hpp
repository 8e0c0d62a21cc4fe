// Warnings about limits of the elements of a scene, known before the run: sentences with the
// object, the number and a remedy. None is an error.
//  * Linear tets lock in volume: with Poisson's ratio near 1/2, each of the six tets of a cell
//    would have to keep its volume.
//  * A rod that is curved at rest is a polygon: a pinched ring of 16, 32, 64 edges is 1.10, 1.02,
//    1.005 times as stiff as a round one.
#pragma once

#include <vector>

#include "framework/core/warning.hpp"

namespace tack {

struct SceneConfig;
struct World;

std::vector<Warning> element_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
