#include "geometry/tets/tet_star.hpp"

#include <algorithm>
#include <limits>

#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

constexpr int step_count_max = 8;
constexpr double move_gain_min = 1e-3;    // smallest relative improvement of a step
constexpr double worst_ratio = 1.1;       // tets up to this ratio to the worst one share the ascent direction

// Returns the gradient of the mean ratio of a positive tet by its last corner.
Vec3 slope(const std::array<Vec3, 4>& x, double quality) {
  const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]) / 2;  // gradient of the volume, times 3
  double squares = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b) squares += (x[a] - x[b]).squaredNorm();
  const double volume = area.dot(x[3] - x[0]) / 3;
  return quality * (2.0 / 9 / volume * area + 2 / squares * (x[0] + x[1] + x[2] - 3 * x[3]));
}

}  // namespace

double TetStar::worst_at(const Vec3& position) const {
  double worst = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : faces_) worst = std::min(worst, mean_ratio({mesh_.position(a), mesh_.position(b), mesh_.position(c), position}));
  return worst;
}

bool TetStar::step(Vec3& position) const {
  const double worst = worst_at(position);
  if (!(worst > 0)) return false;
  double step_max = std::numeric_limits<double>::infinity();
  Vec3 of_all = Vec3::Zero(), of_worst = Vec3::Zero();
  for (const Triangle& f : faces_) {
    const std::array<Vec3, 4> x = {mesh_.position(f[0]), mesh_.position(f[1]), mesh_.position(f[2]), position};
    for (int i = 0; i < 3; ++i) step_max = std::min(step_max, (x[i] - position).norm());
    const double quality = mean_ratio(x);
    if (quality > worst_ratio * worst) continue;
    const Vec3 s = slope(x, quality);
    of_all += s;
    if (quality == worst) of_worst = s;
  }
  for (const Vec3& along : {of_all, of_worst}) {
    const double length = along.norm();
    if (!(length > 0)) continue;
    for (double length_step = step_max / 2; length_step > step_max / 100; length_step /= 2) {
      const Vec3 there = position + length_step / length * along;
      if (!(worst_at(there) > (1 + move_gain_min) * worst)) continue;
      position = there;
      return true;
    }
  }
  return false;
}

void TetStar::improve(Vec3& position) const {
  for (int i = 0; i < step_count_max && step(position); ++i) {
  }
}

std::vector<Tet> TetStar::tets(int centre) const {
  std::vector<Tet> all;
  for (const auto& [a, b, c] : faces_) all.push_back({a, b, c, centre});
  return all;
}

}  // namespace tack
