// Overclosure adjustment: moves objects that overlap at the start out of each other, if
// contact.overclosure_adjustment is set.
// Method: sweep over overlapping pairs. A free object is translated along the signed distance of
// the other one until the gap is half the contact distance (plus offsets); if both are free, each
// moves by the other's share of their volume. Sweeping gives room in heaps. No object moves further
// than the given length.
// Fixed objects: prescribed by motions, attached, with attachments to them, or joined by an
// interaction. Rest shapes and selections by position use the adjusted placement.
#pragma once

#include <string>
#include <vector>

#include "framework/scene/scene_config.hpp"
#include "geometry/mesh/mesh.hpp"

namespace tack {

// Moves the meshes, one per object. Returns one line per moved object; for more than ten, the
// largest displacement and the number. Does nothing without contact.overclosure_adjustment. Throws
// InputError, at the later object, with two objects that still overlap and the reason.
std::vector<std::string> adjust_overclosures(const SceneConfig& scene, const Value& root,
                                             std::vector<Mesh>& meshes);

}  // namespace tack
