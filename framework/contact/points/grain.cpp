#include "framework/contact/points/grain.hpp"

#include <Eigen/Geometry>

namespace tack {
namespace {

constexpr double perpendicular = 1e-6;  // sine below which a grain has no direction in the contact

// Returns the orthonormal frame of a triangle.
Mat3 frame_of(const VecX& x, const Triangle& t) {
  const auto [a, b, c] = corners(x, t);
  Mat3 frame;
  frame.col(0) = (b - a).normalized();
  frame.col(2) = (b - a).cross(c - a).normalized();
  frame.col(1) = frame.col(2).cross(frame.col(0));
  return frame;
}

// Returns the grain at a vertex, turned from rest with the triangles there.
Vec3 turned(const ContactSystem& system, const Vec3& grain, int vertex_index, const VecX& x) {
  Vec3 sum = Vec3::Zero();
  for (const int t : system.lagged_surface().topology().triangles_at(vertex_index)) {
    const Triangle& triangle = system.surface().mesh.triangles[t];
    const Vec3 now = frame_of(x, triangle) * (frame_of(system.surface().rest, triangle).transpose() * grain);
    if (now.allFinite()) sum += now;
  }
  return sum;
}

}  // namespace

void scale_across_grain(const ContactSystem& system, const std::vector<Vec3>& grains, const VecX& x, ContactPoints& points) {
  for_each_record(points, [&](auto& c) {
    const double across = system.pairs().tangential(c.law).across;
    if (across == 1) return;
    const bool own = !grains[c.object].isZero();
    const Vec3 grain = turned(system, grains[own ? c.object : c.opposite], c.vertices[own ? 0 : c.own_vertex_count], x);
    const Vec3 along = grain - c.normal.dot(grain) * c.normal;
    if (!(along.norm() > perpendicular * grain.norm())) return;
    c.tangents.col(0) = along.normalized();
    c.tangents.col(1) = across * c.normal.cross(c.tangents.col(0));
  });
}

}  // namespace tack
