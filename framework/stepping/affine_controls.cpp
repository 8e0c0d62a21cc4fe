#include "framework/stepping/affine_controls.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <vector>

#include <Eigen/QR>

namespace tack {
namespace {

constexpr double round_off = 1e-9;  // relative to the size of the vertices, see hold()

// Control vertices and the orthonormal directions that they span.
struct Controls {
  std::vector<int> vertices;
  std::vector<Vec3> directions = {};

  // Returns the part of the position of v that is orthogonal to all directions.
  Vec3 outside(const VecX& x, int v) const {
    Vec3 r = vertex(x, v) - vertex(x, vertices.front());
    for (int pass = 0; pass < 2; ++pass)
      for (const Vec3& d : directions) r -= d.dot(r) * d;
    return r;
  }
};

// Each control vertex is the one that is farthest from the point, line or plane of those before it,
// which keeps all weights of order one.
Controls controls_of(std::span<const int> all, const VecX& x) {
  Controls controls{{all.front()}};
  const auto farthest = [&] {
    return *std::max_element(all.begin(), all.end(), [&](int v, int w) { return controls.outside(x, v).squaredNorm() < controls.outside(x, w).squaredNorm(); });
  };
  controls.vertices.front() = farthest();
  double size = 0;
  while (controls.directions.size() < 3) {
    const int v = farthest();
    const Vec3 r = controls.outside(x, v);
    size = std::max(size, r.norm());
    if (!(r.norm() > round_off * size)) break;
    controls.vertices.push_back(v);
    controls.directions.push_back(r.normalized());
  }
  return controls;
}

}  // namespace

Dependences affine_dependences(std::span<const int> vertices, const VecX& x) {
  const std::vector<int> controls = controls_of(vertices, x).vertices;
  const auto k = static_cast<Eigen::Index>(controls.size()) - 1;
  Eigen::Matrix<double, 3, Eigen::Dynamic> edges(3, k);
  for (Eigen::Index i = 0; i < k; ++i) edges.col(i) = vertex(x, controls[i + 1]) - vertex(x, controls[0]);
  Eigen::ColPivHouseholderQR<Eigen::Matrix<double, 3, Eigen::Dynamic>> solver;
  solver.setThreshold(std::numeric_limits<double>::epsilon());
  if (k > 0) solver.compute(edges);
  Dependences all;
  for (const int v : vertices) {
    if (std::find(controls.begin(), controls.end(), v) != controls.end()) continue;
    Dependence& own = all.emplace_back(Dependence{v, {{controls[0], 1.0}}});
    if (k == 0) continue;
    const VecX weights = solver.solve(vertex(x, v) - vertex(x, controls[0]));
    own.on[0].second -= weights.sum();
    for (Eigen::Index i = 0; i < k; ++i) own.on.emplace_back(controls[i + 1], weights(i));
  }
  return all;
}

bool hold(const Dependences& dependences, const VecX& x) {
  return std::all_of(dependences.begin(), dependences.end(), [&](const Dependence& d) {
    Vec3 sum = Vec3::Zero();
    double size = 0, far = 0;
    for (const auto& [on, weight] : d.on) {
      sum += weight * vertex(x, on);
      size = std::max(size, (vertex(x, on) - vertex(x, d.on[0].first)).norm());
      far = std::max(far, vertex(x, on).norm());
    }
    return (vertex(x, d.vertex) - sum).norm() <= round_off * size + 16 * std::numeric_limits<double>::epsilon() * far;
  });
}

}  // namespace tack
