#include "geometry/mesh/nesting.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace tack {
namespace {

// Returns the solid angle of a triangle seen from the origin; positive if it faces away (Van Oosterom and Strackee 1983).
double solid_angle(const Vec3& a, const Vec3& b, const Vec3& c) {
  const double la = a.norm(), lb = b.norm(), lc = c.norm();
  return 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
}

}  // namespace

std::vector<int> enclosing_windings(const std::vector<Triangle>& triangles, const std::vector<int>& component,
                                    const std::function<Vec3(int)>& at) {
  const int count = component.empty() ? 0 : *std::max_element(component.begin(), component.end()) + 1;
  if (count < 2) return std::vector<int>(static_cast<size_t>(count), 0);
  std::vector<std::vector<Triangle>> members(static_cast<size_t>(count));
  std::vector<Eigen::AlignedBox3d> boxes(static_cast<size_t>(count));
  for (size_t t = 0; t < triangles.size(); ++t) {
    members[component[t]].push_back(triangles[t]);
    for (const int v : triangles[t]) boxes[component[t]].extend(at(v));
  }
  std::vector<int> windings;
  for (int p = 0; p < count; ++p) {
    const Vec3 from = at(members[p].front()[0]);
    double angle = 0;
    for (int q = 0; q < count; ++q) {
      if (q == p || !boxes[q].contains(boxes[p])) continue;
      for (const Triangle& t : members[q]) angle += solid_angle(at(t[0]) - from, at(t[1]) - from, at(t[2]) - from);
    }
    windings.push_back(static_cast<int>(std::lround(angle / (4 * std::numbers::pi))));
  }
  return windings;
}

}  // namespace tack
