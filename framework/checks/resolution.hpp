// Warnings about meshes that are too coarse, or ranges that are too long: sentences with the
// objects, the sizes and a remedy. None is an error: the run continues.
//  * An adhesive interface fails over a process zone of about E W / sigma^2 (W: work of adhesion,
//    sigma: peak traction, E: the softer Young's modulus; Hillerborg et al. 1976). Larger elements
//    fail all at once, too late.
//  * Across one element of a curved surface, whose faces turn by an angle theta from one to the
//    next, the gap changes by about h theta / 2 (h: edge). This should be small against the range.
//  * A contact distance above the element size, or a range above the thickness of a body, reaches
//    other parts of the body.
//  * A single body should have no contact forces at the start.
//  * Two bodies that start within the contact distance press on each other from the start. A
//    warning is printed if that squeezes one of them from opposite sides, as in a fit narrower than
//    the distance, or throws it off.
#pragma once

#include <vector>

#include "framework/core/warning.hpp"

namespace tack {

struct SceneConfig;
struct World;

// The contact system is left at the start.
std::vector<Warning> resolution_warnings(const SceneConfig& scene, World& world);

}  // namespace tack
