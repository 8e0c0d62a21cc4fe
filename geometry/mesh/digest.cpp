#include "geometry/mesh/digest.hpp"

#include <fmt/format.h>

#include "geometry/checksum.hpp"

namespace tack {
namespace {

template <class T>
std::uint32_t checksum(const std::vector<T>& values, std::uint32_t before = 0) {
  const std::uint64_t count = values.size();  // separates the list from the next one
  before = crc32_of(&count, sizeof count, before);
  return crc32_of(values.data(), values.size() * sizeof(T), before);
}

}  // namespace

MeshDigest digest_of(const Mesh& mesh) {
  MeshDigest digest;
  digest.vertex_count = mesh.vertices.size();
  digest.element_count = mesh.tets.size() + mesh.triangles.size() + mesh.edges.size() + mesh.points.size();
  digest.vertices = checksum(mesh.vertices);
  digest.elements = checksum(mesh.points, checksum(mesh.edges, checksum(mesh.triangles, checksum(mesh.tets))));
  for (const auto& [name, vertices] : mesh.tags)
    digest.groups = checksum(vertices, crc32_of(name.data(), name.size() + 1, digest.groups));
  return digest;
}

std::string difference(const MeshDigest& there, const MeshDigest& here) {
  if (there.vertex_count != here.vertex_count)
    return fmt::format("{} vertices there, {} here", there.vertex_count, here.vertex_count);
  if (there.element_count != here.element_count)
    return fmt::format("{} elements there, {} here", there.element_count, here.element_count);
  if (there.vertices != here.vertices) return "its vertices lie elsewhere";
  if (there.elements != here.elements) return "its elements have other vertices";
  return there.groups != here.groups ? "its groups hold other vertices" : "";
}

}  // namespace tack
