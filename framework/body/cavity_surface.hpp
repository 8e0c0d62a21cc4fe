// Surfaces of pressure loads and fluid cavities, from triangles of objects.
#pragma once

#include <string>
#include <vector>

#include "framework/body/selection.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {

// Returns the triangles of an object all of whose vertices are chosen. Their normals point away
// from the medium that exerts the pressure:
//   solid         into the material
//   closed sheet  outwards
//   open sheet    along its normals
// Throws InputError if there are no such triangles, or if they have no two sides.
std::vector<Triangle> pressed_triangles(const Selection& selection,
                                        const SelectionContext& context);

// Triangles of an object all of whose vertices are chosen, by the sides that are exposed to a
// medium around the object.
struct ExposedTriangles {
  std::vector<Triangle> open;    // of sheets with a boundary: both sides are exposed
  std::vector<Triangle> closed;  // of solids and closed sheets: the side of the normals is exposed
};

// Returns the exposed triangles of a selection. The walls of a solid's cavities are in neither
// list. The whole surface, not the selection, decides whether a cavity is closed.
ExposedTriangles exposed_triangles(const Selection& selection, const SelectionContext& context);

// A region of the boundary of a cavity.
struct CavityWall {
  std::vector<Triangle> triangles;
  bool solid = false;  // true: the triangles are faces of solids
};

// Closed boundary of a cavity, with normals that point out of it.
struct CavitySurface {
  std::vector<Triangle> triangles;
  std::vector<Triangle> slits;  // those that close the slits between walls
};

// Returns the closed boundary of a cavity. Slits between edge loops are closed, nearest loops
// first. who: name for messages. Throws InputError with the remedy if an edge stays open or no
// volume is enclosed.
CavitySurface cavity_surface(const std::vector<CavityWall>& walls, const VecX& rest,
                             const std::string& who);
// Returns the selected triangles of one object as a wall of a cavity.
CavityWall cavity_wall(const Selection& selection, const SelectionContext& context);

}  // namespace tack
