// What `tack mesh` prints of meshes.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

void print_lines(const std::vector<std::string>& lines);

// Headed by `title`: counts, size, volume, surface, groups.
void print_contents(const std::string& title, const Mesh& mesh);

}  // namespace tack
