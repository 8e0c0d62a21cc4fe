#include "framework/contact/points/close_pairs.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "framework/contact/stencils/rest_neighbours.hpp"
#include "geometry/broad_phase/candidate_kinds.hpp"
#include "geometry/distance/closest_parameters.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

// Weights of the vertices of both primitives in their closest points.
std::array<double, 2> weights(const std::array<Vec3, 1>&, const std::array<Vec3, 1>&) { return {1, 1}; }
std::array<double, 3> weights(const std::array<Vec3, 1>& p, const std::array<Vec3, 2>& e) {
  const double u = clamped(point_edge_parameter(p[0], e[0], e[1]));
  return {1, 1 - u, u};
}
std::array<double, 4> weights(const std::array<Vec3, 1>& p, const std::array<Vec3, 3>& t) {
  const Vec3 inside = point_triangle_barycentric(p[0], t[0], t[1], t[2]);
  return {1, inside[0], inside[1], inside[2]};
}
std::array<double, 4> weights(const std::array<Vec3, 2>& a, const std::array<Vec3, 2>& b) {
  const Vec2 at = edge_edge_parameters(a[0], a[1], b[0], b[1]);
  return {1 - at[0], at[0], 1 - at[1], at[1]};
}

template <size_t A, size_t B>
ClosePair close_pair(const VecX& x, const std::array<int, A>& a, const std::array<int, B>& b) {
  ClosePair pair;
  const auto of_vertices = weights(corners(x, a), corners(x, b));
  Vec3 apart = Vec3::Zero();
  for (size_t i = 0; i < A + B; ++i) {
    pair.vertices[i] = i < A ? a[i] : b[i - A];
    pair.weights[i] = of_vertices[i];
    apart += (i < A ? 1 : -1) * of_vertices[i] * Vec3(vertex(x, pair.vertices[i]));
  }
  pair.kind = cut_kind(A, B);
  pair.first_count = A;
  pair.count = A + B;
  pair.distance = apart.norm();
  if (pair.distance > 0) pair.normal = apart / pair.distance;
  return pair;
}

}  // namespace

std::vector<ClosePair> close_pairs(ContactSystem& contact, const VecX& x, double reach) {
  if (!(reach >= 0 && reach <= contact.range()))
    throw InputError(fmt::format("pairs: a reach of {:.4g} m is not between 0 and {:.4g} m, the largest range of contact in this scene; within that alone pairs are searched", reach, contact.range()));
  std::vector<ClosePair> found;
  contact.cover(x, VecX());
  const ContactSurface& surface = contact.surface();
  for_each_kind(surface.mesh, contact.candidates(), [&](const auto& kind) {
    for (const auto& candidate : kind.pairs) {
      const auto a = kind.first(candidate);
      const auto b = kind.second(candidate);
      ClosePair pair = close_pair(x, a, b);
      pair.offset = offset_between(surface, contact.pairs(), a, b);
      if (pair.gap() >= reach) continue;
      found.push_back(pair);
    }
  });
  std::sort(found.begin(), found.end());
  return found;
}

}  // namespace tack
