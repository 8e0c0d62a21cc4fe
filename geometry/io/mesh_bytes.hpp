// A mesh as bytes, for the way from one process to another of the same program.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "geometry/mesh/mesh.hpp"

namespace tack {

std::string bytes_of(const Mesh& mesh);
// Nothing if they are not just those of a mesh: who wrote them may have been damaged.
std::optional<Mesh> mesh_from(std::string_view bytes);

}  // namespace tack
