#include "framework/contact/facing_area.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>

namespace tack {
namespace {

constexpr double always_kept = 1e-3;  // of the whole area

Vec3 normal_of(const VecX& x, const Triangle& t) {
  const Vec3 a = vertex(x, t[0]);
  return (vertex(x, t[1]) - a).cross(vertex(x, t[2]) - a);
}

}  // namespace

FacingArea::FacingArea(const CollisionMesh& mesh, std::vector<char> closed,
                       std::vector<double> whole_area, const VecX& rest)
    : triangles_(mesh.triangles), whole_area_(std::move(whole_area)) {
  const size_t vertices = whole_area_.size();
  start_.assign(vertices + 1, 0);
  for (const Triangle& t : triangles_) {
    third_of_area_.push_back(normal_of(rest, t).norm() / 6);
    for (const int v : t) ++start_[v + 1];
  }
  for (size_t v = 0; v < vertices; ++v) start_[v + 1] += start_[v];
  incident_.resize(start_.back());
  auto next = start_;
  for (size_t t = 0; t < triangles_.size(); ++t)
    for (const int v : triangles_[t]) incident_[next[v]++] = static_cast<int>(t);
  for (const int object : mesh.vertex_object) two_sided_.push_back(!closed[object]);
}

double FacingArea::operator()(const VecX& x, int vertex_index, const Vec3& u) const {
  const int first = start_[vertex_index], last = start_[vertex_index + 1];
  const double whole = whole_area_[vertex_index];
  const double length = u.norm();
  if (first == last || !(length > 0)) return whole;
  double area = 0;
  for (int k = first; k < last; ++k) {
    const Vec3 normal = normal_of(x, triangles_[incident_[k]]);
    const double cosine = -normal.dot(u) / (length * normal.norm());
    const double facing = two_sided_[vertex_index] ? std::abs(cosine) : std::max(0.0, cosine);
    area += third_of_area_[incident_[k]] * facing;
  }
  return std::max(area, always_kept * whole);
}

}  // namespace tack
