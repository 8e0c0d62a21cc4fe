#include "framework/contact/rolling_points.hpp"

#include <map>
#include <utility>

namespace tack {
namespace {

template <int K>
RollingPoint rolling_point(const ContactPoint<K>& c, const ContactSpins::Columns& columns) {
  RollingPoint p;
  p.places = K;
  p.numbers = columns.count;
  for (int i = 0; i < K; ++i) p.vertices[i] = c.vertices[i], p.coefficients[i] = c.coefficients[i];
  for (int j = 0; j < columns.count; ++j) p.vertices[K + j] = columns.numbers[j], p.directions[j] = columns.directions[j];
  p.tangents = c.tangents;
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
  for (int i = 0; i < places; ++i) sum += coefficients[i] * (vertex(x, vertices[i]) - vertex(start, vertices[i]));
  for (int j = 0; j < numbers; ++j) sum += directions[j] * (x(3 * vertices[places + j]) - start(3 * vertices[places + j]));
  return sum;
}

Vec3 RollingPoint::slope_of(int i, const Vec3& slope) const {
  return i < places ? Vec3(coefficients[i] * slope) : Vec3(directions[i - places].dot(slope), 0, 0);
}

void RollingPoint::fill_hessian(const Mat3& curvature, double* slot) const {
  for (int i = 0; i < arity(); ++i)
    for (int j = 0; j <= i; ++j, slot += 9) {
      Eigen::Map<Mat3> block(slot);
      if (i < places) {
        block = coefficients[i] * coefficients[j] * curvature;
        continue;
      }
      const Vec3 by_number = curvature * directions[i - places];
      block.setZero();
      if (j < places) block.row(0) = coefficients[j] * by_number.transpose();
      else block(0, 0) = directions[j - places].dot(by_number);
    }
}

FrictionPoints divided_by_spin(const ContactPoints& points, const ContactSpins& spins, const VecX& x) {
  FrictionPoints divided;
  std::map<std::pair<int, int>, std::vector<RollingPoint>> groups;
  for_each_record(points, [&]<int K>(const ContactPoint<K>& c) {
    ContactSpins::Columns columns;
    spins.append({c.vertices.data(), static_cast<size_t>(c.own)}, c.normal, x, columns);
    spins.append({c.vertices.data() + c.own, static_cast<size_t>(K - c.own)}, c.normal, x, columns);
    if (columns.count == 0) divided.sliding.of<K>().push_back(c);
    else groups[{K, columns.count}].push_back(rolling_point(c, columns));
  });
  for (auto& [kind, list] : groups) {
    RollingGroup& group = divided.rolling.emplace_back(RollingGroup{kind.first, kind.second, std::move(list), {}});
    for (const RollingPoint& p : group.points) group.vertices.insert(group.vertices.end(), p.vertices.begin(), p.vertices.begin() + p.arity());
  }
  return divided;
}

}  // namespace tack
