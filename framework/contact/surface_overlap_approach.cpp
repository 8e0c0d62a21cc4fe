// Deferred subdivision (surface_overlap.hpp): finds the triangles that have come near, and divides
// them.
#include <algorithm>
#include <limits>

#include "framework/contact/surface_overlap.hpp"
#include "framework/contact/triangle_division.hpp"
#include "geometry/parallel.hpp"

namespace tack {

// around: what `some` refers to.
void SurfaceOverlap::add_waiting(int a, int b, std::span<const Waiting> some, const std::vector<int>& around) {
  if (some.empty()) return;
  const int first = static_cast<int>(waiting_.size());
  WaitingPair& pair = waiting_pairs_.emplace_back(WaitingPair{a, b, first, 0, std::numeric_limits<double>::infinity()});
  const int low = some.front().begin, high = some.back().end, shift = static_cast<int>(around_.size()) - low;
  around_.insert(around_.end(), around.begin() + low, around.begin() + high);
  for (Waiting w : some) {
    w.begin += shift;
    w.end += shift;
    waiting_.push_back(w);
    pair.away = std::min(pair.away, w.away);
  }
  pair.end = static_cast<int>(waiting_.size());
}

// Displacements since the start of the step. The points of two triangles have approached by no more
// than the largest difference of the displacements of their corners, bounded by their AABBs.
class SurfaceOverlap::Moves {
 public:
  Moves(const VecX& x, const VecX& start) : moved_(x - start) {}

  void include(Aabb& box, const Triangle& t) const {
    for (const int v : t) box.include(Vec3(vertex(moved_, v)));
  }
  static double nearer(const Aabb& a, const Aabb& b) { return (a.hi - b.lo).cwiseMax(b.hi - a.lo).norm(); }

 private:
  VecX moved_;
};

std::vector<int> SurfaceOverlap::approach(const VecX& x) {
  if (waiting_.empty()) return {};
  const CollisionMesh& mesh = surface_.mesh;
  const Moves moves(x, held_.x());
  std::vector<Aabb> objects(pairs_.objects());
  for_each(pairs_.objects(), [&](int a) {
    for (int t = first_triangle_[a]; t < first_triangle_[a + 1]; ++t) moves.include(objects[a], mesh.triangles[t]);
  }, 1);
  std::vector<int> pairs;
  for (size_t i = 0; i < waiting_pairs_.size(); ++i)
    if (const WaitingPair& pair = waiting_pairs_[i]; Moves::nearer(objects[pair.a], objects[pair.b]) >= pair.away)
      pairs.push_back(static_cast<int>(i));
  std::vector<int> chosen;
  std::vector<char> come(waiting_.size(), 0);
  for_each(static_cast<int>(pairs.size()), [&](int i) {
    const WaitingPair& pair = waiting_pairs_[pairs[i]];
    const double range = pairs_.point(pair.a, pair.b).range_max();
    for (int k = pair.begin; k < pair.end; ++k) {
      Waiting& w = waiting_[k];
      if (w.begin == w.end) continue;
      Aabb own, other;
      moves.include(own, mesh.triangles[w.triangle]);
      const double farthest = Moves::nearer(own, objects[pair.b]);
      if (farthest < w.away) continue;
      for (int j = w.begin; j < w.end; ++j) moves.include(other, mesh.triangles[around_[j]]);
      come[k] = farthest >= range || Moves::nearer(own, other) >= w.away;
    }
  }, 1);
  for (const int i : pairs)
    for (int k = waiting_pairs_[i].begin; k < waiting_pairs_[i].end; ++k)
      if (come[k]) chosen.push_back(k);
  return chosen.empty() ? std::vector<int>() : divide(chosen);
}

// numbers: of those that wait, ascending. What their parts are made of is out of range as the step begins, and exerts no force.
std::vector<int> SurfaceOverlap::divide(const std::vector<int>& numbers) {
  constexpr int few = 16;
  const int n = static_cast<int>(numbers.size());
  const auto own = [&](int triangle) { return surface_.mesh.vertex_object[surface_.mesh.triangles[triangle][0]]; };
  struct Divided {
    std::vector<ContactSample> samples;
    OverlapFacets parts{};
  };
  std::vector<Divided> found(chunk_count(n, few));
  for_each_chunk(n, [&](int c, int first, int last) {
    TriangleDivision division(surface_.mesh, held_);
    for (int i = first; i < last; ++i) {
      Waiting& w = waiting_[numbers[i]];
      const std::vector<FacedRegion> parts = faced_regions(w.triangle, w.object, std::span(around_).subspan(w.begin, w.end - w.begin));
      w.end = w.begin;  // it waits no more
      const TriangleDivision::What what{w.triangle, w.object, pairs_.point(own(w.triangle), w.object).range_max(), w.depth};
      for (const FacedRegion& faced : parts)
        if (w.cell == TriangleDivision::all) {
          std::vector<TriangleDivision::Left> none;
          division.divide(what, faced.triangles, faced.seen(), {}, found[c].samples, found[c].parts, none);
        } else if (faced.region_pair() == w.region_pair) division.divide_cell(what, w.cell, faced.triangles, faced.seen(), found[c].samples, found[c].parts);
    }
  }, few);
  std::vector<ContactSample> added;
  for (const Divided& chunk : found) added.insert(added.end(), chunk.samples.begin(), chunk.samples.end());
  return insert(added);
}

// Cells of one triangle may come one after another.
std::vector<int> SurfaceOverlap::insert(std::vector<ContactSample>& added) {
  const auto key = [&](const ContactSample& s) {
    return std::array{surface_.mesh.vertex_object[surface_.mesh.triangles[s.triangle][0]], s.object, s.triangle, s.cell, s.region_pair};
  };
  const auto before = [&](const ContactSample& a, const ContactSample& b) { return key(a) < key(b); };
  std::sort(added.begin(), added.end(), before);
  std::vector<ContactSample> all;
  all.reserve(samples_.size() + added.size());
  std::vector<int> places;
  places.reserve(added.size());
  auto known = samples_.begin();
  for (const ContactSample& s : added) {
    while (known != samples_.end() && before(*known, s)) all.push_back(*known++);
    places.push_back(static_cast<int>(all.size()));
    all.push_back(s);
  }
  all.insert(all.end(), known, samples_.end());
  samples_ = std::move(all);
  return places;
}

}  // namespace tack
