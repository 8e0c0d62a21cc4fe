// Runs a reader of foreign mesh files in a process of its own. What VTK, Gmsh and CGAL do with a hostile file
// (crash, loop, take all memory) ends that process and becomes an error that names the file; checks before
// (precheck.hpp) only cover the damage that somebody thought of.
//
// A fork, not a new program: this is a library, and starting a program again takes 0.1 s. A fork of a program
// with threads has only the one that forked; it is safe because the reader takes no lock that another thread
// could have held (glibc mends its own for malloc and files), starts no parallel loop, and leaves by _exit.
//
// Limits: 1 GiB of memory and 64 times the file's size more than the program has (not with the address sanitizer,
// which maps terabytes); 5 s of processor time and a second for each 256 KiB.
#pragma once

#include <filesystem>

#include "geometry/mesh/mesh.hpp"

namespace tack {

using MeshReader = Mesh (*)(const std::filesystem::path& path);

// What the reader returns. Throws the InputError that it throws, or one that says how it ended.
Mesh read_isolated(const std::filesystem::path& path, MeshReader read);

}  // namespace tack
