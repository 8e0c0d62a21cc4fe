// Orders boxes along a space-filling curve, so that neighbours in the order are neighbours in
// space. Key: 63-bit Morton code of the box centre (21 bits an axis, one cubic grid around all
// centres), ties by index. A total order: the result does not depend on the number of threads.
#pragma once

#include <vector>

#include "geometry/broad_phase/aabb.hpp"

namespace tack {

// Returns the permutation: order[k] is the index of the k-th box. Boxes must be finite and not
// empty. Boxes of one rigid group (>= 0) are consecutive, at the position of the first of them.
std::vector<int> space_order(const std::vector<Aabb>& boxes,
                             const std::vector<int>& rigid_group = {});

}  // namespace tack
