// Body restricted to selected elements, for energies with a `select`.
#pragma once

#include "framework/body/selection.hpp"

namespace tack {

// Returns the body with the tets, triangles, edges and points all of whose vertices are chosen; for
// composite tets, all of whose corners are. Throws InputError if there are none.
Body selected_elements(const Selection& selection, const SelectionContext& context);

}  // namespace tack
