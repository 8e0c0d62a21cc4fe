// Whether bodies have the sizes that are meant: a mesh in millimetres that is read in metres is a thousand times as large, fits in its scene, and runs.
// Two scales of a scene tell, body by body, of those that move:
//  * The contact distance is a thousandth to a twentieth of what touches. A thousand times as large, a body is 2e4 to 1e6 contact distances long,
//    and a metre or more: below that, the distance is meant to be small.
//  * A solid stands under its own weight where the pressure rho g L at its base is below Young's modulus; a thousand times as large, it does not.
#pragma once

#include <string>
#include <vector>

namespace tack {

struct SceneConfig;
struct World;

// Where a body is, how much it weighs and how fast it starts: "0.1 x 0.2 x 0.1 m, 2 kg, 1.5 m/s"; without what is zero. body: its number.
std::string size_text(const World& world, int body);

std::vector<std::string> scale_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
