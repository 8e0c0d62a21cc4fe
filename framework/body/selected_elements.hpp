// A body cut to some of its elements: what an energy with a `select` acts on.
#pragma once

#include "framework/body/selection.hpp"

namespace tack {

// The body with those of its tets, triangles, edges and points all of whose vertices are chosen; of composite tets the corners
// count. Throws InputError if there are none.
Body selected_elements(const Selection& selection, const SelectionContext& context);

}  // namespace tack
