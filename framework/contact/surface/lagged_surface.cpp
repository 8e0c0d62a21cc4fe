#include "framework/contact/surface/lagged_surface.hpp"

#include <Eigen/Geometry>
#include <cmath>

#include "geometry/parallel.hpp"

namespace tack {

void LaggedSurface::update(const VecX& x) {
  x_ = x;
  normals_.resize(mesh_.triangles.size());
  areas_.resize(mesh_.triangles.size());
  for_each(static_cast<int>(mesh_.triangles.size()), [&](int t) {
    const Triangle& v = mesh_.triangles[t];
    const Vec3 a = vertex(x, v[0]);
    const Vec3 n = Vec3(vertex(x, v[1]) - a).cross(vertex(x, v[2]) - a);
    const double twice = n.norm();
    areas_[t] = twice / 2;
    normals_[t] = twice > 0 ? Vec3(n / twice) : Vec3::Zero();
  });
}

double LaggedSurface::tributary_area(int vertex_index) const {
  double area = 0;
  for (const int t : topology_.triangles_at(vertex_index)) area += areas_[t] / 3;
  return area;
}

double LaggedSurface::codimensional_area(int vertex_index) const {
  const double radius = topology_.particle_radius(vertex_index);
  double area = M_PI * radius * radius;
  for (const int e : topology_.rods_at(vertex_index)) {
    const auto& [a, b] = mesh_.edges[e];
    area += rod_width_[mesh_.vertex_object[a]] / 2 * (vertex(x_, b) - vertex(x_, a)).norm();
  }
  return area;
}

double LaggedSurface::codimensional_area(int vertex_index, const Vec3& n) const {
  const double radius = topology_.particle_radius(vertex_index);
  double area = M_PI * radius * radius;
  const auto rods = topology_.rods_at(vertex_index);
  const bool end = rods.size() == 1 && topology_.triangles_at(vertex_index).empty();
  for (const int e : rods) {
    const auto& [a, b] = mesh_.edges[e];
    const double width = rod_width_[mesh_.vertex_object[a]];
    const Vec3 along = vertex(x_, b) - vertex(x_, a);
    area += width / 2 * along.cross(n).norm();
    if (end) area += M_PI / 4 * width * width * std::abs(along.normalized().dot(n));
  }
  return area;
}

double LaggedSurface::area_per_vertex(int vertex_index, const Vec3& n) const {
  double area = 0;
  int facing = 0;
  for (const int t : topology_.triangles_at(vertex_index))
    if (cosine(t, n) > facing_cosine_min) area += area_per_vertex(t), ++facing;
  return facing > 0 ? area / facing : 0;
}

double LaggedSurface::cosine(int triangle, const Vec3& n) const {
  const double cosine = -normals_[triangle].dot(n);
  return topology_.two_sided(triangle) ? std::abs(cosine) : cosine;
}

}  // namespace tack
