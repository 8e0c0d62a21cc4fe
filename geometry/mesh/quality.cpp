#include "geometry/mesh/quality.hpp"

namespace tack {

double tet_volume(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& d) {
  return (b - a).cross(c - a).dot(d - a) / 6.0;
}

double tet_volume(const Mesh& mesh, int tet) {
  const auto& x = mesh.vertices;
  const auto& [a, b, c, d] = mesh.tets[tet];
  return tet_volume(x[a], x[b], x[c], x[d]);
}

double triangle_area(const Vec3& a, const Vec3& b, const Vec3& c) {
  return 0.5 * (b - a).cross(c - a).norm();
}

double triangle_area(const Mesh& mesh, int triangle) {
  const auto& x = mesh.vertices;
  const auto& [a, b, c] = mesh.triangles[triangle];
  return triangle_area(x[a], x[b], x[c]);
}

double triangle_area(const VecX& x, const Triangle& triangle) {
  const auto [a, b, c] = corners(x, triangle);
  return triangle_area(a, b, c);
}

std::vector<int> inverted_tets(const Mesh& mesh) {
  std::vector<int> inverted;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) {
    if (!(tet_volume(mesh, t) > 0)) inverted.push_back(t);
  }
  return inverted;
}

double total_volume(const Mesh& mesh) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.tets.size()); ++t) sum += tet_volume(mesh, t);
  return sum;
}

double total_area(const Mesh& mesh) {
  double sum = 0;
  for (int t = 0; t < static_cast<int>(mesh.triangles.size()); ++t) sum += triangle_area(mesh, t);
  return sum;
}

}  // namespace tack
