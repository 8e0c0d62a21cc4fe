#include "framework/contact/area_integral/weight_relaxation.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cmath>
#include <string>

#include "geometry/errors.hpp"

namespace tack {
namespace {

constexpr double factor_min = 0.01;
constexpr double growth_max = 1.2;  // of t from step to step: slow changes may oscillate again

// History array with the key (point, object of the triangle), once per triangle. Values: index of
// the triangle among those of its object, lagged values, change, factor.
const std::string name = "contact/thin_shares";
constexpr int width = 10;

LaggedWeight::Values values_of(const TriangleWeight& s) { return {s.weight, s.normal.x(), s.normal.y(), s.normal.z()}; }

// Returns the first triangle of an object; its triangles are consecutive.
int first_triangle(const CollisionMesh& mesh, int object) {
  const auto of_earlier = [&](const Triangle& t) { return mesh.vertex_object[t[0]] < object; };
  return static_cast<int>(std::partition_point(mesh.triangles.begin(), mesh.triangles.end(), of_earlier) - mesh.triangles.begin());
}

}  // namespace

void relax_weights(int point, std::span<const int> triangles, double range, const LaggedWeights& before, std::vector<TriangleWeight>& weights,
                   LaggedWeights& now) {
  const size_t first = now.size();
  double along = 0, squared = 0, previous_factor = 1;
  auto known = std::lower_bound(before.begin(), before.end(), point, [](const LaggedWeight& s, int p) { return s.point < p; });
  for (size_t i = 0; i < triangles.size(); ++i) {
    if (!(weights[i].distance < range)) continue;
    while (known != before.end() && known->point == point && known->triangle < triangles[i]) ++known;
    LaggedWeight& s = now.emplace_back(LaggedWeight{point, triangles[i], values_of(weights[i]), {}, 1});
    if (known == before.end() || known->point != point || known->triangle != triangles[i]) continue;
    for (int k = 0; k < 4; ++k) {
      s.change[k] = s.values[k] - known->values[k];
      const double turn = known->change[k] - s.change[k];
      along += known->change[k] * turn;
      squared += turn * turn;
    }
    previous_factor = known->factor;
  }
  const double found = along > 0 && squared > 0 ? previous_factor * along / squared : 1;
  const double factor = std::clamp(found, factor_min, std::min(1.0, growth_max * previous_factor));
  size_t at = first;
  for (TriangleWeight& weight : weights) {
    if (!(weight.distance < range)) continue;
    LaggedWeight& s = now[at++];
    s.factor = factor;
    if (factor == 1) continue;
    for (int k = 0; k < 4; ++k) s.values[k] -= (1 - factor) * s.change[k];
    weight.weight = s.values[0];
    if (const Vec3 normal(s.values[1], s.values[2], s.values[3]); normal.norm() > 0) weight.normal = normal.normalized();
  }
}

LaggedWeights weights_of(const History& history, const CollisionMesh& mesh) {
  LaggedWeights weights;
  const auto found = history.find(name);
  if (found == history.end()) return weights;
  const HistoryArray& array = found->second;
  if (array.width != width || array.keys.size() != static_cast<size_t>(array.entries())) throw InputError("the history '" + name + "' has another shape");
  weights.reserve(array.keys.size());
  for (int i = 0; i < array.entries(); ++i) {
    const auto& [point, object] = array.keys[i];
    const double* v = array.values.data() + width * i;
    const int triangle = first_triangle(mesh, object) + static_cast<int>(v[0]);
    if (triangle < 0 || triangle >= static_cast<int>(mesh.triangles.size()) || mesh.vertex_object[mesh.triangles[triangle][0]] != object)
      throw InputError("the history '" + name + "' does not fit the triangles of its objects");
    weights.push_back({point, triangle, {v[1], v[2], v[3], v[4]}, {v[5], v[6], v[7], v[8]}, v[9]});
  }
  return weights;
}

void store_weights(const LaggedWeights& weights, const CollisionMesh& mesh, History& history) {
  history.erase(name);
  if (weights.empty()) return;
  HistoryArray& array = history[name] = {width, {}, {}};
  array.keys.reserve(weights.size());
  array.values.reserve(width * weights.size());
  int object = -1, first = 0;
  for (const LaggedWeight& s : weights) {
    if (const int here = mesh.vertex_object[mesh.triangles[s.triangle][0]]; here != object) object = here, first = first_triangle(mesh, here);
    array.keys.push_back({s.point, object});
    array.values.push_back(s.triangle - first);
    array.values.insert(array.values.end(), s.values.begin(), s.values.end());
    array.values.insert(array.values.end(), s.change.begin(), s.change.end());
    array.values.push_back(s.factor);
  }
}

}  // namespace tack
