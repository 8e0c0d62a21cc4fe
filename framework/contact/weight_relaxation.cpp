#include "framework/contact/weight_relaxation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "framework/contact/contact_history.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double least_part = 0.01;
constexpr double growth = 1.2;  // from step to step: what creeps is about to swing again

// By the point and the triangle's object, which may have several in their order: the number of the triangle among those of its object, what was held, its change, its part.
const std::string name = "contact/thin_shares";
constexpr int width = 10;

LaggedWeight::Values values_of(const TriangleWeight& s) { return {s.share, s.normal.x(), s.normal.y(), s.normal.z()}; }

// Returns the first triangle of an object; its triangles are consecutive.
int first_triangle(const CollisionMesh& mesh, int object) {
  const auto of_earlier = [&](const Triangle& t) { return mesh.vertex_object[t[0]] < object; };
  return static_cast<int>(std::partition_point(mesh.triangles.begin(), mesh.triangles.end(), of_earlier) - mesh.triangles.begin());
}

}  // namespace

void relax_weights(int point, std::span<const int> triangles, double range, const LaggedWeights& before, std::vector<TriangleWeight>& shares,
                  LaggedWeights& now) {
  const size_t first = now.size();
  double along = 0, squared = 0, part_before = 1;
  auto known = std::lower_bound(before.begin(), before.end(), point, [](const LaggedWeight& s, int p) { return s.point < p; });
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (!(shares[i].distance < range)) continue;
    while (known != before.end() && known->point == point && known->triangle < triangles[i]) ++known;
    LaggedWeight& s = now.emplace_back(LaggedWeight{point, triangles[i], values_of(shares[i]), {}, 1});
    if (known == before.end() || known->point != point || known->triangle != triangles[i]) continue;
    for (int k = 0; k < 4; ++k) {
      s.change[k] = s.held[k] - known->held[k];
      const double turn = known->change[k] - s.change[k];
      along += known->change[k] * turn;
      squared += turn * turn;
    }
    part_before = known->part;
  }
  const double found = along > 0 && squared > 0 ? part_before * along / squared : 1;
  const double part = std::clamp(found, least_part, std::min(1.0, growth * part_before));
  size_t at = first;
  for (TriangleWeight& share : shares) {
    if (!(share.distance < range)) continue;
    LaggedWeight& s = now[at++];
    s.part = part;
    if (part == 1) continue;
    for (int k = 0; k < 4; ++k) s.held[k] -= (1 - part) * s.change[k];
    share.share = s.held[0];
    if (const Vec3 normal(s.held[1], s.held[2], s.held[3]); normal.norm() > 0) share.normal = normal.normalized();
  }
}

LaggedWeights weights_of(const History& history, const CollisionMesh& mesh) {
  LaggedWeights shares;
  const auto found = history.find(name);
  if (found == history.end()) return shares;
  const HistoryArray& array = found->second;
  if (array.width != width || array.keys.size() != static_cast<size_t>(array.entries())) throw InputError("the history '" + name + "' has another shape");
  shares.reserve(array.keys.size());
  for (int i = 0; i < array.entries(); ++i) {
    const auto& [point, object] = array.keys[i];
    const double* v = array.values.data() + width * i;
    const int triangle = first_triangle(mesh, object) + static_cast<int>(v[0]);
    if (triangle < 0 || triangle >= static_cast<int>(mesh.triangles.size()) || mesh.vertex_object[mesh.triangles[triangle][0]] != object)
      throw InputError("the history '" + name + "' does not fit the triangles of its objects");
    shares.push_back({point, triangle, {v[1], v[2], v[3], v[4]}, {v[5], v[6], v[7], v[8]}, v[9]});
  }
  return shares;
}

void forget_shares(History& history) { history.erase(name); }

void store_weights(const LaggedWeights& shares, const CollisionMesh& mesh, History& history) {
  history.erase(name);
  if (shares.empty()) return;
  HistoryArray& array = history[name] = {width, {}, {}};
  array.keys.reserve(shares.size());
  array.values.reserve(width * shares.size());
  int object = -1, first = 0;
  for (const LaggedWeight& s : shares) {
    if (const int here = mesh.vertex_object[mesh.triangles[s.triangle][0]]; here != object) object = here, first = first_triangle(mesh, here);
    array.keys.push_back({s.point, object});
    array.values.push_back(s.triangle - first);
    array.values.insert(array.values.end(), s.held.begin(), s.held.end());
    array.values.insert(array.values.end(), s.change.begin(), s.change.end());
    array.values.push_back(s.part);
  }
}

}  // namespace tack
