// Surfaces on which loads and chambers press, from triangles of objects.
#pragma once

#include <string>
#include <vector>

#include "framework/body/selection.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {

// Returns the triangles of an object all of whose vertices are chosen, oriented so that their
// normals point away from the medium that presses:
//   solid         into the material
//   closed sheet  outwards
//   open sheet    along its normals
// Throws InputError if there are no such triangles, or if they have no two sides.
std::vector<Triangle> pressed_triangles(const Selection& selection,
                                        const SelectionContext& context);

// Triangles of an object all of whose vertices are chosen, by the sides from which a medium around
// the object reaches them.
struct ExposedTriangles {
  std::vector<Triangle> open;    // of sheets with a boundary: both sides
  std::vector<Triangle> closed;  // of solids and closed sheets: the outside, where normals lead
};

// Returns the exposed triangles of a selection. The walls of a solid's cavities are in neither
// list. The whole surface, not the selection, decides whether a cavity is closed.
ExposedTriangles exposed_triangles(const Selection& selection, const SelectionContext& context);

// A region of the boundary of a chamber.
struct ChamberPart {
  std::vector<Triangle> triangles;
  bool solid = false;  // they are faces of solids, which have an outside
};

// Boundary of a chamber, with normals that point out of it.
struct ChamberSurface {
  std::vector<Triangle> triangles;
  // The triangles that close the slits between parts
  std::vector<Triangle> slits;
};

// Returns the closed boundary. Regions with open edges are joined, nearest edge loop to nearest.
// who: name for messages. Throws InputError with the remedy if an edge stays open or no volume is
// enclosed.
ChamberSurface chamber_surface(const std::vector<ChamberPart>& parts, const VecX& rest,
                               const std::string& who);
// Returns the region of the boundary that the selected triangles of one object form.
ChamberPart chamber_part(const Selection& selection, const SelectionContext& context);

}  // namespace tack
