// Bounds of a step: pairs of primitives and elements, each with the largest fraction of the step
// that it allows by itself. For methods that treat blocks of unknowns differently, and for studies.
#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <span>
#include <string_view>
#include <vector>

namespace tack {

/// Kind of a cut. `other`: of a step filter of a plugin that names vertices alone.
enum class CutKind { edge_edge, point_triangle, point_edge, point_point, tet, other };

/// Returns "edge_edge", ...
constexpr std::string_view to_string(CutKind kind) {
  constexpr std::string_view names[] = {"edge_edge", "point_triangle", "point_edge", "point_point",
                                        "tet",       "other"};
  return names[static_cast<int>(kind)];
}

/// Returns the kind of a cut of two primitives, by their vertices: two edges, or a point and a
/// triangle, edge or point.
constexpr CutKind cut_kind(size_t first, size_t second) {
  if (first == 2) return CutKind::edge_edge;
  return second == 3   ? CutKind::point_triangle
         : second == 2 ? CutKind::point_edge
                       : CutKind::point_point;
}

/// Two primitives, or an element, that allow less than the whole step.
struct StepCut {
  CutKind kind = CutKind::other;
  std::array<int, 8> vertices{};      // global: of the first primitive, then of the second
  int first_count = 0;                // vertices of the first primitive; of an element, all
  int count = 0;                      // vertices
  double step = 0;                    // largest feasible fraction of the step, for these alone
  std::array<int, 2> bodies{-1, -1};  // of the first and the second primitive; -1: none

  std::span<const int> all_vertices() const {
    return {vertices.data(), static_cast<std::size_t>(count)};
  }
  /// Orders cuts by kind and vertices. Two cuts of one step are never equal.
  friend bool operator<(const StepCut& a, const StepCut& b) {
    if (a.kind != b.kind) return a.kind < b.kind;
    const auto first = a.all_vertices(), second = b.all_vertices();
    return std::lexicographical_compare(first.begin(), first.end(), second.begin(), second.end());
  }
};

/// Makes a cut of the vertices of two primitives, or of an element (second empty).
inline StepCut step_cut(CutKind kind, std::span<const int> first, std::span<const int> second,
                        double step) {
  StepCut cut;
  cut.kind = kind;
  cut.step = step;
  for (const auto& primitive : {first, second})
    for (const int v : primitive)
      if (cut.count < static_cast<int>(cut.vertices.size())) cut.vertices[cut.count++] = v;
  cut.first_count = std::min(static_cast<int>(first.size()), cut.count);
  return cut;
}

/// The cuts of a step, sorted, with the blocks of unknowns that move them.
struct StepCuts {
  std::vector<StepCut> cuts;
  std::vector<int> block_start;  // cuts + 1, into blocks
  std::vector<int> blocks;       // of each cut, ascending

  std::span<const int> blocks_of(int cut) const {
    return {blocks.data() + block_start[cut], blocks.data() + block_start[cut + 1]};
  }
};

/// Bound of the step of a block: `alone`, the other blocks at rest; `together`, every block makes
/// any part of its step up to its own bound.
enum class BlockBound { alone, together };

/// Parts of the unknowns that step filters bound: all vertices of a unit move by the same fraction
/// of their displacements. A unit is a block, or several blocks that move one vertex together.
struct MotionUnits {
  std::vector<int> of_vertex;  // global; -1: at rest
  int count = 0;
};

}  // namespace tack
