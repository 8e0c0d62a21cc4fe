#include <algorithm>

#include "framework/contact/area_integral/vertex_quadrature.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Offsets of the lists of a chunk in the joined lists.
struct QuadratureOffsets {
  size_t point = 0, group = 0, triangle = 0, weight = 0, edge = 0, other = 0, lagged_weight = 0;
  int contact_point = 0;

  QuadratureOffsets after(const VertexQuadrature& p) const {
    return {point + p.points.size(), group + p.group_begin.size(), triangle + p.triangles.size(), weight + p.weights.size(),
            edge + p.edges.size(), other + p.others.size(), lagged_weight + p.lagged_weights.size(), contact_point + p.contact_point_count};
  }
};

}  // namespace

void join(const std::vector<VertexQuadrature>& chunks, VertexQuadrature& all) {
  std::vector<QuadratureOffsets> offsets(1);
  for (const VertexQuadrature& chunk : chunks) offsets.push_back(offsets.back().after(chunk));
  const QuadratureOffsets& end = offsets.back();
  all.points.resize(end.point);
  all.group_begin.resize(end.group + 1);
  all.group_begin.back() = static_cast<int>(end.point);
  all.triangles.resize(end.triangle);
  all.weights.resize(end.weight);
  all.edges.resize(end.edge);
  all.others.resize(end.other);
  all.lagged_weights.resize(end.lagged_weight);
  all.contact_point_count = end.contact_point;
  for_each(static_cast<int>(chunks.size()), [&](int c) {
    const VertexQuadrature& chunk = chunks[c];
    const QuadratureOffsets& at = offsets[c];
    const auto shift = [](size_t by, int& first, int& last) {
      first += static_cast<int>(by);
      last += static_cast<int>(by);
    };
    for (size_t i = 0; i < chunk.points.size(); ++i) {
      VertexQuadraturePoint& p = all.points[at.point + i] = chunk.points[i];
      shift(at.triangle, p.triangle_begin, p.triangle_end);
      if (p.weight_begin >= 0) p.weight_begin += static_cast<int>(at.weight);
      shift(at.edge, p.edge_begin, p.edge_end);
      shift(at.other, p.other_begin, p.other_end);
      p.contact_point += at.contact_point;
    }
    for (size_t i = 0; i < chunk.group_begin.size(); ++i) all.group_begin[at.group + i] = chunk.group_begin[i] + static_cast<int>(at.point);
    const auto copy = [](const auto& from, auto& to, size_t offset) { std::copy(from.begin(), from.end(), to.begin() + static_cast<std::ptrdiff_t>(offset)); };
    copy(chunk.triangles, all.triangles, at.triangle);
    copy(chunk.weights, all.weights, at.weight);
    copy(chunk.edges, all.edges, at.edge);
    copy(chunk.others, all.others, at.other);
    copy(chunk.lagged_weights, all.lagged_weights, at.lagged_weight);
  }, 4);
}

}  // namespace tack
