// Digest of a mesh by which it is recognised: counts, and checksums of its arrays.
#pragma once

#include <cstdint>
#include <string>

#include "geometry/mesh/mesh.hpp"

namespace tack {

struct MeshDigest {
  std::uint64_t vertex_count = 0, element_count = 0;
  std::uint32_t vertices = 0, elements = 0, groups = 0;  // checksums
  friend bool operator==(const MeshDigest&, const MeshDigest&) = default;
};

MeshDigest digest_of(const Mesh& mesh);

// Returns the first difference: "8 vertices there, 27 here", "its vertices lie elsewhere", ...; ""
// if there is none.
std::string difference(const MeshDigest& there, const MeshDigest& here);

}  // namespace tack
