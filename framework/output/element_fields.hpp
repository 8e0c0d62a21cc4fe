// Numbers of elements in frames: per cell, not a number where an object has none.
#pragma once

#include "framework/output/vtu.hpp"

namespace tack {

struct World;

// Those of `names` that are fields of elements, at x:
//   von_mises_stress  of the Cauchy stress of all energies of the element together; of sheets, in their middle [Pa]
//   plastic_strain    accumulated; the largest if several of its energies flow
std::vector<CellField> element_fields(const std::vector<std::string>& names, const World& world, const VecX& x,
                                      const FrameGeometry& geometry);

}  // namespace tack
