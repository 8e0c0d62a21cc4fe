// Warnings about bodies of unlikely sizes. A mesh in millimetres that is read in metres is a
// thousand times too large, yet fits in its scene and runs.
// Two scales are examined for each body that moves:
//  * The contact distance is a thousandth to a twentieth of what touches. A body that is a thousand
//    times too large is 2e4 to 1e6 contact distances long, and a metre or more. In a smaller body
//    the distance is meant to be small.
//  * A solid stands under its own weight if the pressure rho g L at its base is below Young's
//    modulus. A solid that is a thousand times too large does not stand.
#pragma once

#include <string>
#include <vector>

namespace tack {

struct SceneConfig;
struct World;

// Returns the extent, mass and initial speed of the body number `body`: "0.1 x 0.2 x 0.1 m, 2 kg,
// 1.5 m/s". A mass or speed of zero is left out.
std::string size_text(const World& world, int body);

std::vector<std::string> scale_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
