#include "geometry/tets/tet_star.hpp"

#include <algorithm>
#include <limits>

#include "geometry/tets/mean_ratio.hpp"

namespace tack {
namespace {

constexpr int most_steps = 8;
constexpr double enough = 1e-3;     // by which part a step has to make the worst tet better
constexpr double about_as = 1.1;    // times the worst: those that a step follows together

// The gradient of the mean ratio of a positive tet by its last corner.
Vec3 slope(const std::array<Vec3, 4>& x, double quality) {
  const Vec3 area = (x[1] - x[0]).cross(x[2] - x[0]) / 2;  // the volume grows along it
  double squares = 0;
  for (int a = 0; a < 4; ++a)
    for (int b = 0; b < a; ++b) squares += (x[a] - x[b]).squaredNorm();
  const double volume = area.dot(x[3] - x[0]) / 3;
  return quality * (2.0 / 9 / volume * area + 2 / squares * (x[0] + x[1] + x[2] - 3 * x[3]));
}

}  // namespace

double TetStar::worst_at(const Vec3& place) const {
  double worst = std::numeric_limits<double>::infinity();
  for (const auto& [a, b, c] : faces_) worst = std::min(worst, mean_ratio({mesh_.place(a), mesh_.place(b), mesh_.place(c), place}));
  return worst;
}

bool TetStar::step(Vec3& place) const {
  const double worst = worst_at(place);
  if (!(worst > 0)) return false;
  double reach = std::numeric_limits<double>::infinity();
  Vec3 of_all = Vec3::Zero(), of_worst = Vec3::Zero();
  for (const Triangle& f : faces_) {
    const std::array<Vec3, 4> x = {mesh_.place(f[0]), mesh_.place(f[1]), mesh_.place(f[2]), place};
    for (int i = 0; i < 3; ++i) reach = std::min(reach, (x[i] - place).norm());
    const double quality = mean_ratio(x);
    if (quality > about_as * worst) continue;
    const Vec3 s = slope(x, quality);
    of_all += s;
    if (quality == worst) of_worst = s;
  }
  for (const Vec3& along : {of_all, of_worst}) {
    const double length = along.norm();
    if (!(length > 0)) continue;
    for (double way = reach / 2; way > reach / 100; way /= 2) {
      const Vec3 there = place + way / length * along;
      if (!(worst_at(there) > (1 + enough) * worst)) continue;
      place = there;
      return true;
    }
  }
  return false;
}

void TetStar::climb(Vec3& place) const {
  for (int i = 0; i < most_steps && step(place); ++i) {
  }
}

std::vector<Tet> TetStar::tets(int centre) const {
  std::vector<Tet> all;
  for (const auto& [a, b, c] : faces_) all.push_back({a, b, c, centre});
  return all;
}

}  // namespace tack
