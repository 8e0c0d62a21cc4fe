#include "framework/profile/pair_counts.hpp"

#include <algorithm>

#include "geometry/broad_phase/candidate_kinds.hpp"

namespace tack {
namespace {

class Counter {
 public:
  explicit Counter(const CollisionMesh& mesh) : mesh_(mesh) {}

  // Returns the counts of the objects of two vertices (global).
  PairCount& of(int v, int w) { return of_objects(std::minmax({mesh_.vertex_object[v], mesh_.vertex_object[w]})); }
  // Successive stencils mostly belong to one pair.
  PairCount& of_objects(const ObjectIds& pair) {
    if (!last_ || pair != last_pair_) last_ = &counts_[pair], last_pair_ = pair;
    return *last_;
  }
  std::map<ObjectIds, PairCount> take() { return std::move(counts_); }

 private:
  const CollisionMesh& mesh_;
  std::map<ObjectIds, PairCount> counts_;
  PairCount* last_ = nullptr;
  ObjectIds last_pair_;
};

void count_candidates(const CollisionMesh& mesh, const Candidates& candidates, Counter& counter) {
  for_each_kind(mesh, candidates, [&](const auto& kind) {
    for (const auto& pair : kind.pairs) ++counter.of(kind.first(pair)[0], kind.second(pair)[0]).candidates;
  });
}

// The edges of a pair have the law of its safety barrier.
bool is_safety_barrier(const PairTable& pairs, int a, int b, int law) {
  for (int part = -1; part < pairs.region_pair_count(a, b); ++part)
    if (pairs.original_law(law) == pairs.edge(a, b, part).law) return true;
  return false;
}

void count_stencils(const ContactSystem& contact, Counter& counter) {
  const auto& object = contact.surface().mesh.vertex_object;
  for_each_kind(contact.contacts(), [&](auto kind, const auto& stencils, const double*) {
    using Kind = decltype(kind);
    for (const auto& s : stencils) {
      const int v = s.vertices[0], w = s.vertices[Kind::first_vertices];
      PairCount& count = counter.of(v, w);
      if constexpr (is_interior<Kind>) ++count.interior_points;
      else if constexpr (std::is_same_v<Kind, EdgeEdgeKind>) ++count.edges;
      else ++(is_safety_barrier(contact.pairs(), object[v], object[w], s.law) ? count.safety_barriers : count.points);
    }
  });
}

void count_friction(const ContactPoints& points, Counter& counter) {
  for_each_record(points, [&](const auto& c) { ++counter.of_objects(std::minmax({c.object, c.opposite})).friction; });
}

}  // namespace

PairCount& PairCount::operator+=(const PairCount& other) {
  candidates += other.candidates;
  points += other.points;
  interior_points += other.interior_points;
  safety_barriers += other.safety_barriers;
  edges += other.edges;
  friction += other.friction;
  return *this;
}

std::map<ObjectIds, PairCount> count_pairs(const ContactSystem& contact, const FrictionTerm* friction) {
  Counter counter(contact.surface().mesh);
  count_candidates(contact.surface().mesh, contact.candidates(), counter);
  count_stencils(contact, counter);
  if (friction) count_friction(friction->points(), counter);
  return counter.take();
}

}  // namespace tack
