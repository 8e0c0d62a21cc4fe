#include "geometry/tets/tet_overlap.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <numeric>

namespace tack {
namespace {

using Corners = std::array<Vec3, 4>;

double six_volumes(const Corners& x) { return (x[1] - x[0]).cross(x[2] - x[0]).dot(x[3] - x[0]); }

// Returns the point where a plane cuts an edge whose corners have the signed distances p > 0 and n <= 0.
Vec3 cut(const Vec3& in, double p, const Vec3& out, double n) { return in + p / (p - n) * (out - in); }

// Appends the part of a tet in front of the plane, cut into tets of either orientation.
void clip(const Corners& x, const Vec3& point, const Vec3& normal, std::vector<Corners>& parts) {
  std::array<double, 4> d;
  std::array<int, 4> order;
  int in = 0;
  for (int i = 0; i < 4; ++i) {
    d[i] = normal.dot(x[i] - point);
    if (d[i] > 0) order[in++] = i;
  }
  for (int i = 0, out = in; i < 4; ++i)
    if (!(d[i] > 0)) order[out++] = i;
  const auto at = [&](int i) -> const Vec3& { return x[order[i]]; };
  const auto on = [&](int i, int j) { return cut(at(i), d[order[i]], at(j), d[order[j]]); };
  const auto prism = [&](const std::array<Vec3, 3>& a, const std::array<Vec3, 3>& b) {
    parts.push_back({a[0], a[1], a[2], b[2]});
    parts.push_back({a[0], a[1], b[2], b[1]});
    parts.push_back({a[0], b[1], b[2], b[0]});
  };
  if (in == 4) parts.push_back(x);
  else if (in == 1) parts.push_back({at(0), on(0, 1), on(0, 2), on(0, 3)});
  else if (in == 3) prism({at(0), at(1), at(2)}, {on(0, 3), on(1, 3), on(2, 3)});
  else if (in == 2) prism({at(0), on(0, 2), on(0, 3)}, {at(1), on(1, 2), on(1, 3)});
}

}  // namespace

double shared_volume(const Corners& a, const Corners& b) {
  constexpr std::array<Triangle, 4> inward = {{{1, 3, 2}, {0, 2, 3}, {0, 3, 1}, {0, 1, 2}}};
  std::vector<Corners> parts = {a}, next;
  for (const auto& [i, j, k] : inward) {
    const Vec3 normal = (b[j] - b[i]).cross(b[k] - b[i]);
    next.clear();
    for (const Corners& part : parts) clip(part, b[i], normal, next);
    std::swap(parts, next);
  }
  double sum = 0;
  for (const Corners& part : parts) sum += std::abs(six_volumes(part));
  return sum / 6;
}

std::vector<TetOverlap> tet_overlaps(const std::vector<Corners>& ones, const std::vector<Corners>& others) {
  struct Box {
    Vec3 low, high;
  };
  const auto box_of = [](const Corners& x) {
    Box box{x[0], x[0]};
    for (const Vec3& p : x) box.low = box.low.cwiseMin(p), box.high = box.high.cwiseMax(p);
    return box;
  };
  std::vector<Box> boxes;
  double widest = 0;
  for (const Corners& x : others) {
    boxes.push_back(box_of(x));
    widest = std::max(widest, boxes.back().high.x() - boxes.back().low.x());
  }
  std::vector<int> order(others.size());  // by ascending x
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(), [&](int i, int j) { return boxes[i].low.x() < boxes[j].low.x(); });
  std::vector<TetOverlap> found;
  for (int i = 0; i < static_cast<int>(ones.size()); ++i) {
    const Box box = box_of(ones[i]);
    const size_t first = found.size();
    auto at = std::lower_bound(order.begin(), order.end(), box.low.x() - widest, [&](int j, double x) { return boxes[j].low.x() < x; });
    for (; at != order.end() && boxes[*at].low.x() < box.high.x(); ++at) {
      const Box& other = boxes[*at];
      if (!((box.low.array() < other.high.array()).all() && (other.low.array() < box.high.array()).all())) continue;
      if (const double volume = shared_volume(ones[i], others[*at]); volume > 0) found.push_back({i, *at, volume});
    }
    std::sort(found.begin() + static_cast<std::ptrdiff_t>(first), found.end(), [](const TetOverlap& a, const TetOverlap& b) { return a.other < b.other; });
  }
  return found;
}

}  // namespace tack
