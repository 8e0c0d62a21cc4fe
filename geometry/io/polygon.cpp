#include "geometry/io/polygon.hpp"

#include <fmt/format.h>

#include "geometry/errors.hpp"

namespace tack {
namespace {

Vec3 normal(const Mesh& mesh, int a, int b, int c) {
  const auto& x = mesh.vertices;
  return (x[b] - x[a]).cross(x[c] - x[a]);
}

void check_indices(const Mesh& mesh, const std::vector<int>& polygon, const std::string& where) {
  const int count = static_cast<int>(mesh.vertices.size());
  if (polygon.size() < 3) {
    throw InputError(fmt::format("{}: a polygon of {} vertices: it needs at least 3", where,
                                 polygon.size()));
  }
  for (int v : polygon) {
    if (v >= 0 && v < count) continue;
    throw InputError(fmt::format("{} refers to vertex {} (counted from 0) of {}: correct the index "
                                 "or add the vertex",
                                 where, v, count));
  }
}

// Returns twice the area vector of the polygon, the sum of the normals of any fan.
Vec3 area_vector(const Mesh& mesh, const std::vector<int>& polygon) {
  Vec3 sum = Vec3::Zero();
  for (std::size_t i = 1; i + 1 < polygon.size(); ++i) {
    sum += normal(mesh, polygon[0], polygon[i], polygon[i + 1]);
  }
  return sum;
}

bool sees_all(const Mesh& mesh, const std::vector<int>& polygon, std::size_t corner,
              const Vec3& facing) {
  const std::size_t n = polygon.size();
  for (std::size_t i = 1; i + 1 < n; ++i) {
    const Vec3 part = normal(mesh, polygon[corner], polygon[(corner + i) % n],
                             polygon[(corner + i + 1) % n]);
    if (!(part.dot(facing) > 0)) return false;
  }
  return true;
}

}  // namespace

void add_polygon(Mesh& mesh, const std::vector<int>& polygon, const std::string& where) {
  check_indices(mesh, polygon, where);
  const std::size_t n = polygon.size();
  const Vec3 facing = area_vector(mesh, polygon);
  std::size_t corner = 0;
  // A triangle has one fan; validate_mesh reports flat ones.
  while (n > 3 && corner < n && !sees_all(mesh, polygon, corner, facing)) ++corner;
  if (corner == n) {
    throw InputError(fmt::format("{}: a polygon of {} vertices that no fan of triangles from a "
                                 "corner covers: cut it into triangles before",
                                 where, n));
  }
  for (std::size_t i = 1; i + 1 < n; ++i) {
    mesh.triangles.push_back(
        {polygon[corner], polygon[(corner + i) % n], polygon[(corner + i + 1) % n]});
  }
}

}  // namespace tack
