#include "framework/contact/surface/pair_radii.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <utility>

namespace tack {
namespace {

// The contact range of one class of objects with another, or with itself [m].
struct ClassRange {
  int a, b;
  double range;
};

double surface_range(const PairTable& pairs, int a, int b) {
  double range = 0;
  for (int region_pair = -1; region_pair < pairs.region_pair_count(a, b); ++region_pair)
    for (const PairRole* role : {&pairs.point(a, b, region_pair), &pairs.point(b, a, region_pair), &pairs.edge(a, b, region_pair), &pairs.codimensional(a, b, region_pair)})
      range = std::max({range, role->range_max(), role->safety_barrier_range, role->search_range, role->bonds ? pairs.bond_range() : 0});
  return range;
}

double edge_range(const ContactSurface& surface, const PairTable& pairs, int a, int b) {
  const bool rods = surface.rod_width[a] > 0 && surface.rod_width[b] > 0;
  double range = 0;
  for (int region_pair = -1; region_pair < pairs.region_pair_count(a, b); ++region_pair)
    range = std::max({range, pairs.edge(a, b, region_pair).range, rods ? pairs.codimensional(a, b, region_pair).range_max() : 0});
  return range;
}

std::vector<ClassRange> class_ranges(const PairTable& pairs, const std::function<double(int, int)>& range_of) {
  std::vector<ClassRange> ranges;
  for (const auto& [a, b] : pairs.classes().examples())
    if (const double range = range_of(a, b); range > 0) ranges.push_back({pairs.classes().of(a), pairs.classes().of(b), range});
  return ranges;
}

// Returns the smallest range of each class with any other; 0 for a class without ranges.
std::vector<double> smallest_ranges(const PairTable& pairs, const std::vector<ClassRange>& ranges) {
  std::vector<double> smallest(pairs.classes().count(), std::numeric_limits<double>::infinity());
  for (const auto& [a, b, range] : ranges)
    for (const int c : {a, b}) smallest[c] = std::min(smallest[c], range);
  std::replace_if(smallest.begin(), smallest.end(), [](double range) { return std::isinf(range); }, 0.0);
  return smallest;
}

// Returns inflation radii of classes with radius(a) + radius(b) >= range(a, b). vertices: the number
// of surface vertices of each class.
std::vector<double> distribute_radii(const PairTable& pairs, std::vector<ClassRange> ranges, const std::vector<int>& vertices) {
  std::vector<double> radius = smallest_ranges(pairs, ranges);
  for (double& r : radius) r *= 0.5;
  const auto alike_first = [](const ClassRange& r) { return std::pair(r.a != r.b, -r.range); };
  std::stable_sort(ranges.begin(), ranges.end(), [&](const ClassRange& r, const ClassRange& s) { return alike_first(r) < alike_first(s); });
  for (const auto& [a, b, range] : ranges) {
    const double lacking = range - radius[a] - radius[b];
    if (lacking <= 0) continue;
    if (a == b) radius[a] = 0.5 * range;
    else radius[vertices[a] < vertices[b] ? a : b] += lacking;
  }
  return radius;
}

std::vector<double> by_object(const PairTable& pairs, const std::vector<double>& by_class) {
  std::vector<double> all;
  for (int i = 0; i < pairs.objects(); ++i) all.push_back(by_class[pairs.classes().of(i)]);
  return all;
}

}  // namespace

InflationRadii pair_radii(const ContactSurface& surface, const PairTable& pairs) {
  std::vector<int> vertices(pairs.classes().count(), 0);
  for (const int v : surface.mesh.vertices) ++vertices[pairs.classes().of(surface.mesh.vertex_object[v])];
  const auto ranges = class_ranges(pairs, [&](int a, int b) { return surface_range(pairs, a, b); });
  const auto edge_ranges = class_ranges(pairs, [&](int a, int b) { return edge_range(surface, pairs, a, b); });
  return {by_object(pairs, distribute_radii(pairs, ranges, vertices)), by_object(pairs, distribute_radii(pairs, edge_ranges, vertices))};
}

}  // namespace tack
