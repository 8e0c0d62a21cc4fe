#include "geometry/mesh/overlaps.hpp"

#include <algorithm>
#include <cmath>

#include "geometry/broad_phase/overlap_pairs.hpp"

namespace tack {
namespace {

constexpr double tolerance = 1e-7;  // in longest edges of the smaller tet

using Corners = std::array<Vec3, 4>;

constexpr std::array<Triangle, 4> tet_faces = {{{1, 2, 3}, {0, 3, 2}, {0, 1, 3}, {0, 2, 1}}};
constexpr std::array<Edge, 6> tet_edges = {{{0, 1}, {0, 2}, {0, 3}, {1, 2}, {1, 3}, {2, 3}}};

double longest_edge(const Corners& x) {
  double longest = 0;
  for (const auto& [a, b] : tet_edges) longest = std::max(longest, (x[a] - x[b]).squaredNorm());
  return std::sqrt(longest);
}

// Returns true if their projections on an axis overlap by at most `slack` [m]. One such axis is a proof.
bool apart(const Corners& a, const Corners& b, const Vec3& axis, double slack) {
  double low_a = axis.dot(a[0]), high_a = low_a, low_b = axis.dot(b[0]), high_b = low_b;
  for (int i = 1; i < 4; ++i) {
    const double pa = axis.dot(a[i]), pb = axis.dot(b[i]);
    low_a = std::min(low_a, pa), high_a = std::max(high_a, pa);
    low_b = std::min(low_b, pb), high_b = std::max(high_b, pb);
  }
  return std::min(high_a - low_b, high_b - low_a) <= slack * axis.norm();
}

// Tests the axes that suffice for two tets (separating-axis theorem): face normals, and cross products of an edge of each.
bool apart(const Corners& a, const Corners& b, double slack) {
  for (const Corners* of : {&a, &b})
    for (const auto& [i, j, k] : tet_faces) {
      const Corners& x = *of;
      if (apart(a, b, (x[j] - x[i]).cross(x[k] - x[i]), slack)) return true;
    }
  for (const auto& [i, j] : tet_edges)
    for (const auto& [k, l] : tet_edges) {
      const Vec3 u = a[j] - a[i], v = b[l] - b[k], axis = u.cross(v);
      const bool parallel = axis.squaredNorm() <= 1e-24 * u.squaredNorm() * v.squaredNorm();
      if (!parallel && apart(a, b, axis, slack)) return true;
    }
  return false;
}

// The relation of overlap_pairs.
struct TetsOverlap {
  const Mesh& mesh;

  // Returns corners relative to `from`, so that round-off scales with their size and not with their distance to the origin.
  Corners corners(int tet, const Vec3& from) const {
    Corners x;
    for (int i = 0; i < 4; ++i) x[i] = mesh.vertices[mesh.tets[tet][i]] - from;
    return x;
  }
  bool accept(int s, int t) const {
    const Vec3& from = mesh.vertices[mesh.tets[s][0]];
    const Corners a = corners(s, from), b = corners(t, from);
    return !apart(a, b, tolerance * std::min(longest_edge(a), longest_edge(b)));
  }
  std::array<int, 2> pair(int s, int t) const { return {s, t}; }
};

}  // namespace

std::vector<std::array<int, 2>> overlapping_tets(const Mesh& mesh) {
  const TetsOverlap overlap{mesh};
  std::vector<Aabb> boxes(mesh.tets.size());
  for (std::size_t t = 0; t < boxes.size(); ++t) {
    for (const int v : mesh.tets[t]) boxes[t].include(mesh.vertices[v]);
    boxes[t].inflate(-tolerance / 4 * longest_edge(overlap.corners(static_cast<int>(t), Vec3::Zero())));
  }
  std::vector<std::array<int, 2>> pairs;
  overlap_pairs(Bvh(boxes), overlap, pairs);
  return pairs;
}

}  // namespace tack
