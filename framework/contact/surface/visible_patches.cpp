#include "framework/contact/surface/visible_patches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

const double same_patch_cosine = std::cos(50 * M_PI / 180);  // of the angle between normals within a patch
constexpr double area_tolerance = 1e-9;                       // of equal projected areas, relative

// Returns the distance of a point from a feature of a triangle, a corner (0 to 2) or an edge (3 to 5), in the plane of the triangle.
// lift: from that plane to the point. Round-off is relative to the distance from the feature's corner; the root of a difference of
// squared distances would have one of 1e-8 of the height, and decide on which side of an edge the point lies.
double distance_in_plane(const Vec3& p, const Vec3& lift, const std::array<Vec3, 3>& t, int feature) {
  const Vec3& corner = t[feature % 3];
  const Vec3 offset = p - lift - corner;
  return feature < 3 ? offset.norm() : (t[(feature + 1) % 3] - corner).normalized().cross(offset).norm();
}

}  // namespace

int VisiblePatches::patch_of(const Vec3& normal) const {
  for (int k = 0; k < count; ++k)
    if (normal.dot(patches[k].normal) > same_patch_cosine) return k;
  return -1;
}

QueryPoint PatchFinder::at_vertex(int vertex_index) const {
  return {vertex(lagged_.x(), vertex_index), mesh_.vertex_object[vertex_index], lagged_.tributary_area(vertex_index),
          vertex_index, -1};
}

QueryPoint PatchFinder::inside_triangle(int triangle, const Vec3& x, double area) const {
  return {x, mesh_.vertex_object[mesh_.triangles[triangle][0]], area, -1, triangle};
}

bool PatchFinder::normal_towards(const QueryPoint& from, int triangle, Vec3& normal, double& height) const {
  const int corner = mesh_.triangles[triangle][0];
  normal = lagged_.normal(triangle);
  height = normal.dot(from.position - vertex(lagged_.x(), corner));
  if (height > 0) return true;
  if (!lagged_.topology().two_sided(triangle)) return false;
  normal = -normal;
  height = -height;
  return true;
}

double PatchFinder::area_towards(const QueryPoint& from, const Vec3& normal) const {
  if (from.vertex < 0) return from.area * std::max(0.0, lagged_.cosine(from.triangle, normal));
  double area = 0, most = 0;
  for (const int t : lagged_.topology().triangles_at(from.vertex)) {
    const double cosine = lagged_.cosine(t, normal);
    area += lagged_.area(t) / 3 * std::max(0.0, cosine);
    most = std::max(most, cosine);
  }
  return most > facing_cosine_min ? area : 0;
}

bool PatchFinder::well_in_front(const QueryPoint& from, int triangle, double height, double squared) const {
  if (mesh_.vertex_object[mesh_.triangles[triangle][0]] != from.object) return true;
  return height >= self_height_per_distance_min * std::sqrt(squared);
}

void PatchFinder::add_if_facing(const QueryPoint& from, int triangle, double squared_max) {
  Vec3 normal;
  double height;
  if (!normal_towards(from, triangle, normal, height) || height * height >= squared_max) return;
  const double area = area_towards(from, normal);
  if (!(area > 0)) return;
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3 t0 = vertex(lagged_.x(), t[0]), t1 = vertex(lagged_.x(), t[1]), t2 = vertex(lagged_.x(), t[2]);
  const PointTriangleType type = point_triangle_type(from.position, t0, t1, t2);
  const double squared = point_triangle_distance(from.position, t0, t1, t2, type);
  if (squared >= squared_max || !well_in_front(from, triangle, height, squared)) return;
  const SurfaceTopology& topology = lagged_.topology();
  const int feature = static_cast<int>(type);  // three vertices, three edges, the face
  const bool continues = type == PointTriangleType::P_T ||
                         (feature < 3 ? topology.smooth_vertex(t[feature]) && (!region_ || region_->surrounds_vertex(topology, t[feature]))
                                      : topology.smooth_edge(triangle, feature - 3) && (!region_ || region_->surrounds_edge(topology, triangle, feature - 3)));
  const double in_plane = type == PointTriangleType::P_T ? 0 : distance_in_plane(from.position, height * normal, {t0, t1, t2}, feature);
  facing_.push_back({normal, area, squared, in_plane, continues, triangle});
}

// Groups facing triangles into patches, nearest seed first. Triangles that meet in the closest
// point are equally near: the seed is the one with the largest projected area of the point. Round-off
// does not decide about equal areas where the surface ends: there the seed is the triangle with the
// smallest distance in its plane, the one that the point lies over, or past the edge of.
VisiblePatches PatchFinder::group_by_normal() {
  VisiblePatches visible;
  while (!facing_.empty() && visible.count < VisiblePatches::count_max) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const FacingTriangle& s : facing_) nearest = std::min(nearest, s.squared);
    const FacingTriangle* seed = nullptr;
    for (const FacingTriangle& s : facing_) {
      if (!(s.squared <= nearest * (1 + distance_tolerance))) continue;
      const bool equal = seed && std::abs(s.area - seed->area) <= area_tolerance * seed->area;
      const bool at_boundary = equal && !(s.continues && seed->continues);
      if (!seed || (at_boundary ? s.in_plane < seed->in_plane : s.area > seed->area)) seed = &s;
    }
    const Vec3 normal = seed->normal;
    visible.patches[visible.count++] = {normal, seed->area, std::sqrt(seed->squared), lagged_.area_per_vertex(seed->triangle),
                                        seed->continues ? 0 : seed->in_plane, seed->triangle};
    std::erase_if(facing_, [&](const FacingTriangle& s) { return s.normal.dot(normal) > same_patch_cosine; });
  }
  return visible;
}

// The patch continues where the surface bends away: its triangles need not be front-facing now. A
// triangle of a sheet is tested further: it turns to the point, and may belong to its own object.
int PatchFinder::patch_of(const QueryPoint& from, const VisiblePatches& visible, int triangle) const {
  if (visible.count == 0) return -1;
  const int corner = mesh_.triangles[triangle][0];
  if (!lagged_.topology().two_sided(triangle)) return visible.patch_of(lagged_.normal(triangle));
  Vec3 normal;
  double height;
  normal_towards(from, triangle, normal, height);
  const int patch = visible.patch_of(normal);
  if (patch < 0 || mesh_.vertex_object[corner] != from.object) return patch;
  const Triangle& t = mesh_.triangles[triangle];
  const double squared = point_triangle_distance(from.position, vertex(lagged_.x(), t[0]), vertex(lagged_.x(), t[1]),
                                                 vertex(lagged_.x(), t[2]));
  return well_in_front(from, triangle, height, squared) ? patch : -1;
}

}  // namespace tack
