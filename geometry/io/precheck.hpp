// Checks of mesh files before a library reads them, for damage on which that library (CGAL 5.5,
// VTK 9.1, Gmsh 4.8) would crash, run a script, or silently return an incomplete mesh.
// Errors: InputError naming the file, the damage and the remedy.
#pragma once

#include <string>

namespace tack {

// Checks that every property belongs to an element, and every element has a name and a count.
void precheck_ply(const std::string& name);

// Checks that the size of a binary file fits its number of triangles.
void precheck_stl(const std::string& name);

// Checks in legacy .vtk before version 5 that lists of cells have the announced number of entries.
void precheck_vtk(const std::string& name);

// Checks the sizes of buffers, and that views and accessors lie inside them.
void precheck_gltf(const std::string& name);

// Checks that the version is 2.2 or 4.1 (Gmsh would run any other file as a script of its geometry
// language), and in an ASCII 2.2 file that elements use existing nodes.
void precheck_msh(const std::string& name);

}  // namespace tack
