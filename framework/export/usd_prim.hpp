// Prims of an object in a USD file as text.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "framework/export/run_shapes.hpp"

namespace tack {

// A Mesh, BasisCurves or Points.
struct UsdPrim {
  std::string type, name;
  std::vector<int> vertices;  // of the object, one per point of the prim
  double width = 0;           // diameter of curves and points [m]
  std::string properties;     // lines of text that do not change with time
};

// Returns the prims of an object: faces as Mesh, edges as BasisCurves, points as Points. All but
// the first have names of their own. scale: factor of lengths.
std::vector<UsdPrim> usd_prims(const ExportedObject& object, const std::string& name, double scale);

// Returns a name that USD accepts: letters, digits and '_', not beginning with a digit.
std::string usd_identifier(const std::string& name);

// Appends "[(x, y, z), ...]" in single precision.
void append_points(fmt::memory_buffer& text, const std::vector<int>& vertices,
                   const std::vector<Vec3>& x, double scale);

// Appends "[(lowest), (highest)]" of the points, enlarged by half of the width.
void append_extent(fmt::memory_buffer& text, const UsdPrim& prim, const std::vector<Vec3>& x,
                   double scale);

}  // namespace tack
