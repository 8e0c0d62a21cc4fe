#include "framework/stepping/predicted_motion.hpp"

#include <algorithm>
#include <optional>

#include "framework/core/debonding.hpp"
#include "framework/core/dependent_sets.hpp"
#include "framework/core/disjoint_sets.hpp"
#include "framework/core/term.hpp"

namespace tack {
namespace {

// Returns a mark per vertex of stencils that debond; empty: none debonds.
std::vector<char> debonding(const World& world, const VecX& from, const VecX& to) {
  std::vector<char> marked(world.dofs.vertex_count(), 0);
  for (const Term* term : world.terms) term->mark_debonding(from, to, marked);
  for (char& m : marked) m = (m & passes_peak) != 0;
  if (std::find(marked.begin(), marked.end(), 1) == marked.end()) marked.clear();
  return marked;
}

// Returns the group of objects of each vertex. Bodies whose vertices depend on those of others move
// as one group with them.
std::vector<int> groups_of_vertices(const World& world) {
  const int bodies = static_cast<int>(world.bodies.size());
  DisjointSets sets(bodies + 1);
  std::vector<int> of(world.dofs.vertex_count());
  for (size_t v = 0; v < of.size(); ++v) {
    const int body = world.body_of(static_cast<int>(v));
    of[v] = body < 0 ? bodies : body;
  }
  join_dependent(world.dofs, of, sets);
  for (int& group : of) group = sets.find(group);
  return of;
}

struct Prediction {
  const World& world;
  const VecX& x;
  const VecX& prescribed;
  const VecX& full;
  const VecX& uniform;

  std::vector<char> marks(const VecX& p) const {
    VecX displacement = prescribed;
    world.dofs.scatter(p, displacement);
    return debonding(world, x, x + displacement);
  }
};

// Reduces the motion object by object. Returns nothing if stencils debond nevertheless.
std::optional<VecX> by_objects(const Prediction& prediction, std::vector<char> marked) {
  const DofMap& dofs = prediction.world.dofs;
  enum Level : char { full, uniform, none };
  const std::vector<int> group = groups_of_vertices(prediction.world);
  std::vector<Level> levels(prediction.world.bodies.size() + 1, full);
  for (VecX p = prediction.full;;) {
    // Accelerations of objects are removed first, before their velocities.
    Level lowest = none;
    for (size_t v = 0; v < marked.size(); ++v)
      if (marked[v]) lowest = std::min(lowest, levels[group[v]]);
    if (lowest == none) return std::nullopt;
    std::vector<char> lowered(levels.size(), 0);
    for (size_t v = 0; v < marked.size(); ++v)
      if (marked[v] && levels[group[v]] == lowest) lowered[group[v]] = 1;
    for (size_t g = 0; g < levels.size(); ++g)
      if (lowered[g]) levels[g] = lowest == full ? uniform : none;
    for (int b = 0; b < dofs.block_count(); ++b) {
      const int g = group[dofs.vertex_of_block(b)];
      if (!lowered[g]) continue;
      if (levels[g] == uniform) p.segment<3>(3 * b) = prediction.uniform.segment<3>(3 * b);
      else p.segment<3>(3 * b).setZero();
    }
    marked = prediction.marks(p);
    if (marked.empty()) return p;
  }
}

// Reduces the motion vertex by vertex. Returns nothing if no vertex moves then, or if stencils debond
// nevertheless.
std::optional<VecX> by_vertices(const Prediction& prediction, std::vector<char> marked) {
  const DofMap& dofs = prediction.world.dofs;
  for (VecX p = prediction.full;;) {
    bool changed = false;
    for (int b = 0; b < dofs.block_count(); ++b)
      if (marked[dofs.vertex_of_block(b)] && !p.segment<3>(3 * b).isZero(0)) p.segment<3>(3 * b).setZero(), changed = true;
    if (!changed || p.isZero(0)) return std::nullopt;
    marked = prediction.marks(p);
    if (marked.empty()) return p;
  }
}

}  // namespace

bool anything_debonds(const World& world, const VecX& from, const VecX& to) { return !debonding(world, from, to).empty(); }

PredictedMotion predicted_motion(const World& world, const VecX& x, const VecX& prescribed, const VecX& full, const VecX& uniform) {
  const Prediction prediction{world, x, prescribed, full, uniform};
  const std::vector<char> marked = prediction.marks(full);
  if (marked.empty()) return {{full}, false};
  PredictedMotion motion;
  if (auto p = by_objects(prediction, marked)) motion.displacements.push_back(*std::move(p));
  if (auto p = by_vertices(prediction, marked)) motion.displacements.push_back(*std::move(p));
  motion.debonds = motion.displacements.empty();
  return motion;
}

}  // namespace tack
