// Checks of mesh files before a library reads them: damage on which that library (CGAL 5.5,
// VTK 9.1, Gmsh 4.8) would crash, run something else or return a part without a word.
// Errors: InputError naming the file, the damage and the remedy.
#pragma once

#include <string>

namespace tack {

// Every property belongs to an element, and every element has a name and a count.
void precheck_ply(const std::string& name);

// A binary file is as long as its number of triangles says.
void precheck_stl(const std::string& name);

// Legacy .vtk before version 5: lists of cells hold as many numbers as they announce.
void precheck_vtk(const std::string& name);

// Buffers are as long as they say, and what is read of them lies in them.
void precheck_gltf(const std::string& name);

// Version 2.2 or 4.1 (anything else Gmsh would run as a script of its geometry language); in an
// ASCII 2.2 file, elements use nodes that exist.
void precheck_msh(const std::string& name);

}  // namespace tack
