// Type of the tets of an object, for its energies.
#pragma once

namespace tack {

enum class Elements {
  linear,     // each by itself
  composite,  // eight together, into which a tet of ten nodes is divided
              // (geometry/tets/divide_tets.hpp)
  patches     // each by itself but for its volume, of which the mean over neighbours counts
              // (geometry/tets/tet_patches.hpp)
};

}  // namespace tack
