#include "framework/contact/facing_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "geometry/distance/point_triangle.hpp"

namespace tack {
namespace {

const double one_piece = std::cos(50 * M_PI / 180);  // of the angle between normals within a piece

}  // namespace

int FacingView::piece_of(const Vec3& normal) const {
  for (int k = 0; k < count; ++k)
    if (normal.dot(pieces[k].normal) > one_piece) return k;
  return -1;
}

Viewpoint FacingViewer::vertex_view(int vertex_index) const {
  return {vertex(held_.x(), vertex_index), mesh_.vertex_object[vertex_index], held_.whole(vertex_index),
          vertex_index, -1};
}

Viewpoint FacingViewer::inner_view(int triangle, const Vec3& x, double area) const {
  return {x, mesh_.vertex_object[mesh_.triangles[triangle][0]], area, -1, triangle};
}

bool FacingViewer::turn(const Viewpoint& from, int triangle, Vec3& normal, double& height) const {
  const int corner = mesh_.triangles[triangle][0];
  normal = held_.normal(triangle);
  height = normal.dot(from.position - vertex(held_.x(), corner));
  if (height > 0) return true;
  if (!held_.topology().two_sided(triangle)) return false;
  normal = -normal;
  height = -height;
  return true;
}

double FacingViewer::area_towards(const Viewpoint& from, const Vec3& normal) const {
  if (from.vertex < 0) return from.whole * std::max(0.0, held_.cosine(from.triangle, normal));
  double area = 0, most = 0;
  for (const int t : held_.topology().triangles_at(from.vertex)) {
    const double cosine = held_.cosine(t, normal);
    area += held_.area(t) / 3 * std::max(0.0, cosine);
    most = std::max(most, cosine);
  }
  return most > least_cosine ? area : 0;
}

bool FacingViewer::well_in_front(const Viewpoint& from, int triangle, double height, double squared) const {
  if (mesh_.vertex_object[mesh_.triangles[triangle][0]] != from.object) return true;
  return height >= own_front * std::sqrt(squared);
}

void FacingViewer::consider(const Viewpoint& from, int triangle, double nearer) {
  Vec3 normal;
  double height;
  if (!turn(from, triangle, normal, height) || height * height >= nearer) return;
  const double area = area_towards(from, normal);
  if (!(area > 0)) return;
  const Triangle& t = mesh_.triangles[triangle];
  const Vec3 t0 = vertex(held_.x(), t[0]), t1 = vertex(held_.x(), t[1]), t2 = vertex(held_.x(), t[2]);
  const PointTriangleType type = point_triangle_type(from.position, t0, t1, t2);
  const double squared = point_triangle_distance(from.position, t0, t1, t2, type);
  if (squared >= nearer || !well_in_front(from, triangle, height, squared)) return;
  const SurfaceTopology& topology = held_.topology();
  const int feature = static_cast<int>(type);  // three vertices, three edges, the face
  const bool goes_on = type == PointTriangleType::P_T ||
                       (feature < 3 ? topology.smooth_vertex(t[feature]) && (!region_ || region_->surrounds_vertex(topology, t[feature]))
                                    : topology.smooth_edge(triangle, feature - 3) && (!region_ || region_->surrounds_edge(topology, triangle, feature - 3)));
  const double beyond = goes_on ? 0 : std::sqrt(std::max(0.0, squared - height * height));
  seen_.push_back({normal, area, squared, beyond, triangle});
}

// Faces that meet in the closest point are equally near: the one that the point faces most leads.
FacingView FacingViewer::pieces() {
  FacingView view;
  while (!seen_.empty() && view.count < FacingView::most) {
    double nearest = std::numeric_limits<double>::infinity();
    for (const Seen& s : seen_) nearest = std::min(nearest, s.squared);
    const Seen* leader = nullptr;
    for (const Seen& s : seen_)
      if (s.squared <= nearest * (1 + same_distance) && (!leader || s.area > leader->area)) leader = &s;
    const Vec3 normal = leader->normal;
    view.pieces[view.count++] = {normal, leader->area, std::sqrt(leader->squared), held_.cell(leader->triangle), leader->beyond,
                                 leader->triangle};
    std::erase_if(seen_, [&](const Seen& s) { return s.normal.dot(normal) > one_piece; });
  }
  return view;
}

// A surface that is seen goes on where it bends away: that the point is not in front of such a triangle now
// does not matter. Only a sheet may be the point's own, or turn its other side.
int FacingViewer::piece_of(const Viewpoint& from, const FacingView& view, int triangle) const {
  if (view.count == 0) return -1;
  const int corner = mesh_.triangles[triangle][0];
  if (!held_.topology().two_sided(triangle)) return view.piece_of(held_.normal(triangle));
  Vec3 normal;
  double height;
  turn(from, triangle, normal, height);
  const int piece = view.piece_of(normal);
  if (piece < 0 || mesh_.vertex_object[corner] != from.object) return piece;
  const Triangle& t = mesh_.triangles[triangle];
  const double squared = point_triangle_distance(from.position, vertex(held_.x(), t[0]), vertex(held_.x(), t[1]),
                                                 vertex(held_.x(), t[2]));
  return well_in_front(from, triangle, height, squared) ? piece : -1;
}

}  // namespace tack
