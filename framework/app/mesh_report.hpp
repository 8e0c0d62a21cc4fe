// Tables that `tack mesh` prints about meshes.
#pragma once

#include <string>
#include <vector>

#include "geometry/mesh/mesh.hpp"

namespace tack {

void print_lines(const std::vector<std::string>& lines);

// Prints counts, size, volume, surface area and groups, under the heading `title`.
void print_contents(const std::string& title, const Mesh& mesh);

}  // namespace tack
