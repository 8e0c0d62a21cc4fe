#include "geometry/io/mesh_bytes.hpp"

#include <cstdint>
#include <cstring>

namespace tack {
namespace {

// Writes a list as its count and its values as in memory.
template <class List>
void write(std::string& bytes, const List& list) {
  const std::uint64_t count = list.size();
  bytes.append(reinterpret_cast<const char*>(&count), sizeof count);
  bytes.append(reinterpret_cast<const char*>(list.data()), list.size() * sizeof(list[0]));
}

bool read_count(std::string_view& bytes, std::size_t size, std::uint64_t& count) {
  if (bytes.size() < sizeof count) return false;
  std::memcpy(&count, bytes.data(), sizeof count);
  bytes.remove_prefix(sizeof count);
  return count <= bytes.size() / size;
}

template <class List>
bool read(std::string_view& bytes, List& list) {
  std::uint64_t count = 0;
  if (!read_count(bytes, sizeof(list[0]), count)) return false;
  list.resize(count);
  const std::size_t size = count * sizeof(list[0]);
  if (size > 0) std::memcpy(reinterpret_cast<char*>(list.data()), bytes.data(), size);
  bytes.remove_prefix(size);
  return true;
}

}  // namespace

std::string bytes_of(const Mesh& mesh) {
  std::string bytes;
  write(bytes, mesh.vertices);
  write(bytes, mesh.tets);
  write(bytes, mesh.triangles);
  write(bytes, mesh.edges);
  write(bytes, mesh.points);
  for (const auto& [name, group] : mesh.tags) {
    write(bytes, name);
    write(bytes, group);
  }
  return bytes;
}

std::optional<Mesh> mesh_from(std::string_view bytes) {
  Mesh mesh;
  if (!read(bytes, mesh.vertices) || !read(bytes, mesh.tets) || !read(bytes, mesh.triangles) ||
      !read(bytes, mesh.edges) || !read(bytes, mesh.points))
    return std::nullopt;
  while (!bytes.empty()) {
    std::string name;
    if (!read(bytes, name) || !read(bytes, mesh.tags[name])) return std::nullopt;
  }
  return mesh;
}

}  // namespace tack
