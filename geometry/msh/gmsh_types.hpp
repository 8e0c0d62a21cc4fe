// Codes of element types in .msh files and in Gmsh's interface.
#pragma once

namespace tack::gmsh_types {

constexpr int line = 1, triangle = 2, tet = 4, point = 15;

}  // namespace tack::gmsh_types
