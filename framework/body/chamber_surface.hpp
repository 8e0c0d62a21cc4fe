// The surfaces that loads and chambers press on, from triangles of objects.
#pragma once

#include <string>
#include <vector>

#include "framework/body/selection.hpp"
#include "geometry/mesh/oriented_surface.hpp"

namespace tack {

// Triangles of an object all of whose vertices are chosen, turned so that their normals lead away from what presses on them: into the material of
// solids, outwards of a closed sheet, along its normals from an open one. Throws InputError if there are none, or no two sides.
std::vector<Triangle> pressed_triangles(const Selection& selection, const SelectionContext& context);

// Triangles of an object all of whose vertices are chosen, by the sides from which a medium around
// the object reaches them.
struct ExposedTriangles {
  std::vector<Triangle> open;    // of sheets with a boundary: both sides
  std::vector<Triangle> closed;  // of solids and closed sheets: the outside, where normals lead
};

// Returns the exposed triangles of a selection. The walls of a solid's cavities are in neither
// list. The whole surface decides what is closed, whatever is chosen of it.
ExposedTriangles exposed_triangles(const Selection& selection, const SelectionContext& context);

// A part of what surrounds a chamber.
struct ChamberPart {
  std::vector<Triangle> triangles;
  bool solid = false;  // they are faces of solids, which have an outside
};

// What is around a chamber, with normals that lead out of it.
struct ChamberSurface {
  std::vector<Triangle> triangles;
  std::vector<Triangle> slits;  // of them, those that are of no part: they close the slits between parts
};

// Parts with a boundary are stitched to each other, nearest boundary to nearest. who: for messages. Throws InputError, naming the remedy, where something
// is left open or nothing is enclosed.
ChamberSurface chamber_surface(const std::vector<ChamberPart>& parts, const VecX& rest, const std::string& who);
// Of an object, likewise.
ChamberPart chamber_part(const Selection& selection, const SelectionContext& context);

}  // namespace tack
