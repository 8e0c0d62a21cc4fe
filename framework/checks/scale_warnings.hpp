// Warnings about bodies of unlikely sizes. A mesh in millimetres that is read in metres is a
// thousand times too large, yet fits in its scene and runs.
// Two scales are examined for each body that moves:
//  * The contact distance over the middle side of the body's box. Contact resolves no size below
//    it. A body of 3e4 contact distances and at least a metre was hardly meant: in a smaller body
//    the distance is meant to be small.
//  * A solid stands under its own weight if the pressure rho g L at its base is below Young's
//    modulus: beyond, its sag is as large as itself.
// The bound of the first follows from the shipped scenes, the second needs none. Both as the scenes
// are, and with all lengths of bodies 1000 times as large, of 216 scenes
// (TACK_PRINT_STUDY=1 tack_tests "[checks]" prints most of them):
//
//     scale, of the extreme body    scenes   as it is: range    median   warned    warned at 1000
//     distance / side, contact      190      3e-6 .. 0.1        0.01     1         170
//     rho g L / E, gravity, solid   100      1e-7 .. 0.16       0.01     0         98
//     ------
//     bound of distance / side      1e-5     3e-5     1e-4     3e-4
//     warned at 1000, of 190        66       170      178      186
//     as it is, any size            4        7        9        14
//
// The one scene with a warning as it is has the wrong scale on purpose (hard/). Among those of a
// metre or more no other has a ratio below 3e-4, so that the bound could be ten times as large. It
// is kept low, as a warning that is wrong costs more than one that is missing. Without warning at
// 1000 are scenes with a contact distance of more than a thirtieth of the body, and without
// gravity.
//
// A third scale, without contact and gravity: the extent of a body over that of the largest other
// one. Of 203 shipped scenes with several bodies the largest ratio of a body that moves or is of a
// file is 3; a body of 6 cm beside ones of 80 cm, read in metres, has 75. Warned of above 30, if
// the body is at least a metre large.
#pragma once

#include <string>
#include <vector>

#include "framework/core/warning.hpp"

namespace tack {

struct SceneConfig;
struct World;

// Returns the extent, mass and initial speed of the body number `body`: "100 x 200 x 100 mm, 2 kg,
// 1.5 m/s". A mass or speed of zero is left out.
std::string size_text(const World& world, int body);

// The two scales of a body that moves.
struct BodyScale {
  int body = 0;
  double side = 0;      // the middle side of its box [m]
  double distance = 0;  // the contact distance over it; 0 without contact
  double sag = 0;       // the pressure of its weight at its base over Young's modulus; or 0
};

// Returns the extent of a body over the largest of the others [m each]; 0 without others.
double size_ratio(const std::vector<double>& extents, size_t body);

std::vector<BodyScale> body_scales(const SceneConfig& scene, const World& world);

std::vector<Warning> scale_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
