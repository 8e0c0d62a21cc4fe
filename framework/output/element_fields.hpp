// Fields of elements in frames, per cell; not a number where an object has none.
#pragma once

#include "framework/output/vtu.hpp"

namespace tack {

struct World;

// Returns those of `names` that are fields of elements (frame_fields.hpp), at x.
std::vector<CellField> element_fields(const std::vector<std::string>& names, const World& world,
                                      const VecX& x, const FrameGeometry& geometry);

}  // namespace tack
