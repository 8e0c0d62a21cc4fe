#include "framework/contact/points/rolling_points.hpp"

#include <map>
#include <utility>

namespace tack {
namespace {

template <int K>
RollingPoint rolling_point(const ContactPoint<K>& c, const ContactSpins::Columns& columns) {
  RollingPoint p;
  p.vector_count = K;
  p.scalar_count = columns.count;
  for (int i = 0; i < K; ++i) p.vertices[i] = c.vertices[i], p.coefficients[i] = c.coefficients[i];
  for (int j = 0; j < columns.count; ++j) p.vertices[K + j] = columns.scalar_dofs[j], p.directions[j] = columns.directions[j];
  p.own_vertex_count = c.own_vertex_count;
  p.normal = c.normal;
  p.tangents = c.tangents;
  p.gap = c.gap;
  p.area = c.area;
  p.normal_force = c.normal_force;
  p.object = c.object;
  p.opposite = c.opposite;
  p.law = c.law;
  return p;
}

}  // namespace

Vec3 RollingPoint::moved(const VecX& x, const VecX& start) const {
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i < vector_count; ++i) sum += coefficients[i] * (vertex(x, vertices[i]) - vertex(start, vertices[i]));
  for (int j = 0; j < scalar_count; ++j) sum += directions[j] * (x(3 * vertices[vector_count + j]) - start(3 * vertices[vector_count + j]));
  return sum;
}

Vec3 RollingPoint::slope_of(int i, const Vec3& slope) const {
  return i < vector_count ? Vec3(coefficients[i] * slope) : Vec3(directions[i - vector_count].dot(slope), 0, 0);
}

void RollingPoint::fill_hessian(const Mat3& curvature, double* slot) const {
  for (int i = 0; i < arity(); ++i)
    for (int j = 0; j <= i; ++j, slot += 9) {
      Eigen::Map<Mat3> block(slot);
      if (i < vector_count) {
        block = coefficients[i] * coefficients[j] * curvature;
        continue;
      }
      const Vec3 by_scalar = curvature * directions[i - vector_count];
      block.setZero();
      if (j < vector_count) block.row(0) = coefficients[j] * by_scalar.transpose();
      else block(0, 0) = directions[j - vector_count].dot(by_scalar);
    }
}

FrictionPoints split_by_spin(const ContactPoints& points, const ContactSpins& spins, const VecX& x) {
  FrictionPoints split;
  std::map<std::pair<int, int>, std::vector<RollingPoint>> groups;
  for_each_record(points, [&]<int K>(const ContactPoint<K>& c) {
    ContactSpins::Columns columns;
    spins.append({c.vertices.data(), static_cast<size_t>(c.own_vertex_count)}, c.normal, x, columns);
    spins.append({c.vertices.data() + c.own_vertex_count, static_cast<size_t>(K - c.own_vertex_count)}, c.normal, x, columns);
    if (columns.count == 0) split.sliding.of<K>().push_back(c);
    else groups[{K, columns.count}].push_back(rolling_point(c, columns));
  });
  for (auto& [kind, list] : groups) {
    RollingGroup& group = split.rolling.emplace_back(RollingGroup{kind.first, kind.second, std::move(list), {}});
    for (const RollingPoint& p : group.points) group.vertices.insert(group.vertices.end(), p.vertices.begin(), p.vertices.begin() + p.arity());
  }
  return split;
}

}  // namespace tack
