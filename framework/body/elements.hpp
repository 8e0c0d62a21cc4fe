// Type of the tets of an object, for its energies.
#pragma once

namespace tack {

enum class Elements {
  linear,     // each tet is an element
  composite,  // eight tets, the subdivision of a tet of ten nodes, are an element
              // (geometry/tets/divide_tets.hpp)
  patches     // each tet is an element, with the mean volume ratio of its neighbours
              // (geometry/tets/tet_patches.hpp)
};

}  // namespace tack
