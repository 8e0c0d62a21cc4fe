#include "framework/contact/surface/rest_gaps.hpp"

#include <cmath>
#include <limits>

#include "framework/contact/surface/rest_gap_finder.hpp"
#include "geometry/broad_phase/broad_phase.hpp"
#include "geometry/concatenate.hpp"
#include "geometry/distance/squared_distance.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace {

// Ratio of two consecutive distances with laws of their own.
constexpr double level_ratio = 0.98;

constexpr double no_gap = std::numeric_limits<double>::infinity();

// Returns the search radius of an object for itself [m]: the range of its barriers, and the range of
// the laws of rods, whose pairs adhere only where they press.
double own_search_radius(const ContactSurface& surface, const PairTable& pairs, int object) {
  double radius = 0;
  const auto add = [&](int law) {
    if (law >= 0) radius = std::max(radius, pairs.laws()[law].offset() + pairs.laws()[law].barrier_range());
  };
  for (int region_pair = -1; region_pair < pairs.region_pair_count(object, object); ++region_pair) {
    const PairRole& point = pairs.point(object, object, region_pair);
    for (const int law : {point.law, point.safety_barrier, pairs.edge(object, object, region_pair).law}) add(law);
    if (surface.rod_width[object] > 0) radius = std::max(radius, pairs.codimensional(object, object, region_pair).range);
  }
  return radius;
}

// Returns a filter that allows only pairs within one object.
CollidingObjects only_themselves(const ObjectClasses& classes) {
  CollidingObjects colliding(classes);
  for (const auto& [a, b] : classes.examples())
    if (a != b) colliding.set(a, b, false);
  return colliding;
}

// Returns the largest power of the ratio that is not above a distance [m].
double rounded_down(double distance) {
  const double level = std::pow(level_ratio, std::ceil(std::log(distance) / std::log(level_ratio)));
  return level > distance ? level * level_ratio : level;
}

}  // namespace

RestGaps::RestGaps(const ContactSurface& surface, PairTable& pairs) : surface_(surface), laws_(static_cast<int>(pairs.laws().size())) {
  for (int object = 0; object < pairs.objects(); ++object) search_radius_.push_back(own_search_radius(surface, pairs, object));
  if (std::any_of(search_radius_.begin(), search_radius_.end(), [](double radius) { return radius > 0; })) find_levels(pairs);
  add_laws(pairs);
}

void RestGaps::find_levels(const PairTable& pairs) {
  const CollisionMesh& mesh = surface_.mesh;
  BroadPhase broad_phase(mesh, only_themselves(pairs.classes()));
  InflationRadii radii{search_radius_, search_radius_};
  for (auto* list : {&radii.surface, &radii.edge})
    for (double& radius : *list) radius /= 2;
  broad_phase.update(surface_.rest, VecX(), radii, 0);
  const Candidates& candidates = broad_phase.candidates();
  const std::vector<PointGroup>& groups = candidates.groups.all;
  const RestShape shape(surface_, pairs, search_radius_);
  std::vector<double> of_point(mesh.vertex_object.size(), no_gap);
  const int points = static_cast<int>(groups.size()), edges = static_cast<int>(candidates.edge_edge.size());
  std::vector<Keys> found_points(chunk_count(points)), found_edges(chunk_count(edges));
  std::vector<std::vector<double>> of_edges(chunk_count(edges));
  for_each_chunk(points, [&](int c, int first, int last) {
    RestGapFinder finder(shape, candidates);
    for (int g = first; g < last; ++g) of_point[groups[g].point] = finder.of_point(groups[g], found_points[c]);
  });
  for_each_chunk(edges, [&](int c, int first, int last) {
    RestGapFinder finder(shape, candidates);
    for (int i = first; i < last; ++i)
      if (const double distance = finder.of_edges(i, found_edges[c]); distance < no_gap) of_edges[c].push_back(distance);
  });
  concatenate(found_points, point_gaps_);
  concatenate(found_edges, edge_gaps_);
  std::sort(point_gaps_.begin(), point_gaps_.end());
  std::sort(edge_gaps_.begin(), edge_gaps_.end());
  concatenate(of_edges, levels_);
  for (const double distance : of_point)
    if (distance < no_gap) levels_.push_back(distance);
  for (double& level : levels_) level = rounded_down(level);
  std::sort(levels_.begin(), levels_.end());
  levels_.erase(std::unique(levels_.begin(), levels_.end()), levels_.end());
  if (levels_.empty()) return;
  for (const double distance : of_point) level_of_point_.push_back(distance < no_gap ? level_below(distance) : -1);
}

void RestGaps::add_laws(PairTable& pairs) {
  std::vector<char> own(laws_, 0);
  for (const auto& [a, b] : pairs.classes().examples()) {
    if (a != b || search_radius_[a] == 0) continue;
    for (int region_pair = -1; region_pair < pairs.region_pair_count(a, a); ++region_pair) {
      const PairRole& point = pairs.point(a, a, region_pair);
      for (const int law : {point.law, point.safety_barrier, pairs.edge(a, a, region_pair).law, pairs.codimensional(a, a, region_pair).law})
        if (law >= 0) own[law] = 1;
    }
  }
  for (int law = 0; law < laws_; ++law)
    for (const double level : levels_) {
      const PairLaw original = pairs.laws()[law];
      const bool cut = own[law] && level < original.offset() + original.barrier_range();
      cut_down_.push_back(cut ? pairs.add_cut_down(law, original.from_rest(level)) : law);
    }
  for (const PairLaw& law : pairs.laws()) ranges_.push_back(law.range());
}

int RestGaps::level_below(double distance) const {
  const auto above = std::upper_bound(levels_.begin(), levels_.end(), distance);
  return std::max(0, static_cast<int>(above - levels_.begin()) - 1);
}

int RestGaps::level_of(const Edge& a, const Edge& b) const {
  if (!gap_between(a, b)) return -1;
  return level_below(std::sqrt(squared_distance(corners(surface_.rest, a), corners(surface_.rest, b))));
}

int RestGaps::law_of_edges(int law, const Edge& a, const Edge& b) const { return cut_down(law, level_of(a, b)); }

double RestGaps::offset(double o, const Edge& a, const Edge& b) const { return offset_at(o, level_of(a, b)); }

double RestGaps::offset_at(double o, int level) const { return level < 0 ? o : PairLaw::offset_from_rest(o, levels_[level]); }

}  // namespace tack
