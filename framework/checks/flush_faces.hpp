// Warnings about flat faces of equal extent that lie flush on each other without friction. Their
// overlap does not resist a displacement along the faces, and its boundary follows the meshes: such
// faces slide off each other in directions that the meshes choose.
// A pair of bodies is warned of if all of these hold:
//   - A side of the box of one lies within contact range of a side of the box of the other.
//   - Both sides have equal extents to within the contact distance, and the surfaces fill them.
//   - Nothing acts along the surfaces, and nothing adheres.
//   - Gravity or a load presses on one of the bodies that no motion or attachment guides.
// Faces across the axes are not examined.
#pragma once

#include <vector>

#include "framework/core/warning.hpp"

namespace tack {

struct SceneConfig;
struct World;

std::vector<Warning> flush_face_warnings(const SceneConfig& scene, const World& world);

}  // namespace tack
