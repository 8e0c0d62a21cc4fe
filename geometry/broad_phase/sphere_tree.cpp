#include "geometry/broad_phase/sphere_tree.hpp"

#include <algorithm>

#include "geometry/distance/squared_distance.hpp"
#include "geometry/mesh/surface.hpp"

namespace tack {
namespace {

constexpr int leaf_size = 4;

// Returns whether the segment passes through the interior of the triangle. For segments in its plane or through its edges rounding
// decides; edge-edge distances settle these cases.
bool pierces(const Vec3& p, const Vec3& q, const std::array<Vec3, 3>& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double above = normal.dot(p - t[0]), below = normal.dot(q - t[0]);
  if (above * below >= 0) return false;
  const Vec3 x = p + above / (above - below) * (q - p);
  for (int k = 0; k < 3; ++k)
    if (normal.dot((t[(k + 1) % 3] - t[k]).cross(x - t[k])) < 0) return false;
  return true;
}

Eigen::AlignedBox3d box_of(const std::array<Vec3, 3>& at, int corners) {
  Eigen::AlignedBox3d box;
  for (int k = 0; k < corners; ++k) box.extend(at[k]);
  return box;
}

}  // namespace

SphereTree::SphereTree(const Mesh& mesh) {
  const Surface surface = extract_surface(mesh);
  const auto& x = mesh.vertices;
  for (const Triangle& t : surface.triangles) primitives_.push_back({{x[t[0]], x[t[1]], x[t[2]]}, 3});
  for (const Edge& e : mesh.edges) primitives_.push_back({{x[e[0]], x[e[1]], Vec3::Zero()}, 2});
  for (const int p : mesh.points) primitives_.push_back({{x[p], Vec3::Zero(), Vec3::Zero()}, 1});
  nodes_.emplace_back();
  divide(0, 0, static_cast<int>(primitives_.size()));
}

void SphereTree::divide(int node, int begin, int end) {
  Eigen::AlignedBox3d box, centres;
  for (int i = begin; i < end; ++i) {
    const auto own = box_of(primitives_[i].at, primitives_[i].corners);
    box.extend(own);
    centres.extend(own.center());
  }
  double square = 0;
  if (begin < end) nodes_[node].centre = box.center();
  for (int i = begin; i < end; ++i)
    for (int k = 0; k < primitives_[i].corners; ++k) square = std::max(square, (primitives_[i].at[k] - nodes_[node].centre).squaredNorm());
  nodes_[node].radius = std::sqrt(square);
  if (end - begin <= leaf_size) {
    nodes_[node].first = begin;
    nodes_[node].count = end - begin;
    return;
  }
  int axis = 0;
  centres.sizes().maxCoeff(&axis);
  const int middle = (begin + end) / 2;
  std::nth_element(primitives_.begin() + begin, primitives_.begin() + middle, primitives_.begin() + end, [&](const Primitive& a, const Primitive& b) {
    return box_of(a.at, a.corners).center()[axis] < box_of(b.at, b.corners).center()[axis];
  });
  const int first = static_cast<int>(nodes_.size());
  nodes_[node].first = first;
  nodes_.resize(nodes_.size() + 2);
  divide(first, begin, middle);
  divide(first + 1, middle, end);
}

bool SphereTree::primitives_farther_than(const Primitive& a, const Primitive& b, double distance) {
  const double square = distance * distance;
  const auto edges = [](const Primitive& p) { return p.corners == 3 ? 3 : p.corners - 1; };
  const auto edge = [](const Primitive& p, int k) { return std::array<Vec3, 2>{p.at[k], p.at[(k + 1) % p.corners]}; };
  const auto points_farther_than = [&](const Primitive& p, const Primitive& from) {
    for (int k = 0; k < p.corners; ++k) {
      const std::array<Vec3, 1> point{p.at[k]};
      if (from.corners == 3 && squared_distance(point, from.at) < square) return false;
      if (from.corners == 2 && squared_distance(point, std::array<Vec3, 2>{from.at[0], from.at[1]}) < square) return false;
      if (from.corners == 1 && squared_distance(point, std::array<Vec3, 1>{from.at[0]}) < square) return false;
    }
    return true;
  };
  if (!points_farther_than(a, b) || !points_farther_than(b, a)) return false;
  for (int i = 0; i < edges(a); ++i)
    for (int j = 0; j < edges(b); ++j)
      if (squared_distance(edge(a, i), edge(b, j)) < square) return false;
  const auto pierced = [&](const Primitive& p, const Primitive& by) {
    for (int k = 0; p.corners == 3 && k < edges(by); ++k)
      if (const auto e = edge(by, k); pierces(e[0], e[1], p.at)) return true;
    return false;
  };
  return !pierced(a, b) && !pierced(b, a);
}

bool farther_than(const SphereTree& a, const Eigen::Isometry3d& at_a, const SphereTree& b, const Eigen::Isometry3d& at_b, double distance) {
  const Eigen::Isometry3d from_b = at_a.inverse() * at_b;  // to the frame of a
  std::vector<std::pair<int, int>> open{{0, 0}};
  while (!open.empty()) {
    const auto [i, j] = open.back();
    open.pop_back();
    const SphereTree::Node &p = a.nodes_[i], &q = b.nodes_[j];
    const double least = p.radius + q.radius + distance;
    if ((p.centre - from_b * q.centre).squaredNorm() >= least * least) continue;
    if (p.count > 0 && q.count > 0) {
      for (int k = q.first; k < q.first + q.count; ++k) {
        SphereTree::Primitive moved = b.primitives_[k];
        for (int c = 0; c < moved.corners; ++c) moved.at[c] = from_b * moved.at[c];
        for (int l = p.first; l < p.first + p.count; ++l)
          if (!SphereTree::primitives_farther_than(a.primitives_[l], moved, distance)) return false;
      }
    } else {
      // Divides the larger node. The nearer child is visited first, as it is more likely too close.
      const bool first = q.count > 0 || (p.count == 0 && p.radius >= q.radius);
      const auto gap = [&](int child) {
        return first ? (a.nodes_[child].centre - from_b * q.centre).norm() - a.nodes_[child].radius
                     : (p.centre - from_b * b.nodes_[child].centre).norm() - b.nodes_[child].radius;
      };
      int near = first ? p.first : q.first, far = near + 1;
      if (gap(far) < gap(near)) std::swap(near, far);
      for (const int child : {far, near}) open.emplace_back(first ? child : i, first ? j : child);
    }
  }
  return true;
}

}  // namespace tack
