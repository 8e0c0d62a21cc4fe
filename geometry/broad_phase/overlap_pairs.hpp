// All overlapping pairs between the primitives of two trees, sorted; the same for any number of
// threads.
//
// Key idea: queries are taken eight at a time (a group of the query tree). Their common bound
// descends the other tree once; at a leaf group the queries that reach it are each tested against
// its eight boxes at once. The hits of a query are first collected, then filtered and sorted in
// straight loops. Tasks are fixed runs of query groups with a list of their own; in the end every
// query's partners are copied to the place that a prefix sum over the queries gives them.
//
// `Relation` is plain data with two inlined members, for query q and primitive t:
//   bool accept(int q, int t) const             whether the overlapping pair is wanted
//   std::array<int, 2> pair(int q, int t) const what to write
// and, if it may not want pairs of kin (bvh.hpp),
//   bool skips(int kin) const                   whether it does not, of these
//   bool alone(int kin, const Aabb& box) const  whether nothing else overlaps the box, where it does not
// The result is ordered by q, then t.
#pragma once

#include <array>
#include <bit>
#include <vector>

#include "geometry/broad_phase/bvh.hpp"
#include "geometry/broad_phase/lanes.hpp"
#include "geometry/parallel.hpp"

namespace tack {
namespace detail {

// Calls visit(leaf group) for the groups of the tree that may hold partners of the box. If
// `only_active`, subtrees without an active primitive are skipped; so are those that are all `but_kin`, unless that is -1.
template <class Visit>
void visit_groups(const Bvh& tree, const Aabb& box, bool only_active, int but_kin, const Visit& visit) {
  struct Node {
    int level, group;
  };
  std::array<Node, 128> stack;  // 7 open nodes a level, at most 11 levels for 2^31 primitives
  int top = 0;
  stack[top++] = {tree.levels() - 1, 0};
  while (top > 0) {
    const auto [level, group] = stack[--top];
    if (level == 0) {
      visit(group);
      continue;
    }
    unsigned lanes = tree.boxes(level, group).overlap_mask(box);
    if (only_active) lanes &= tree.active(level, group);
    for (; lanes != 0; lanes &= lanes - 1) {
      const int child = group * Box8::width + std::countr_zero(lanes);
      if (but_kin < 0 || tree.kin(level - 1, child) != but_kin) stack[top++] = {level - 1, child};
    }
  }
}

// The primitives that one query hits, in a buffer that only grows.
struct Row {
  std::vector<int> ids = std::vector<int>(256);
  int count = 0;

  void append(const int* lanes, unsigned mask) {
    if (count + Box8::width > static_cast<int>(ids.size())) ids.resize(2 * ids.size());
    count = static_cast<int>(append_lanes(lanes, mask, ids.data() + count) - ids.data());
  }
  template <class Relation>
  void filter_and_sort(int query, const Relation& relation) {
    int kept = 0;
    for (int k = 0; k < count; ++k) {
      const int other = ids[k];
      ids[kept] = other;
      kept += relation.accept(query, other);
    }
    count = kept;
    sort_distinct(ids.data(), count);
  }
};
using Rows = std::array<Row, Box8::width>;

// With Same, queries and tree are the same tree, and only pairs q < t are found. Subtrees that are all but_kin are skipped (-1: none).
template <bool Same>
void search_group(const Bvh& queries, int group, const Bvh& tree, int but_kin, Rows& rows) {
  const Box8& boxes = queries.boxes(0, group);
  const unsigned active = queries.active(0, group);
  for (Row& row : rows) row.count = 0;
  visit_groups(tree, queries.bound(0, group), active == 0, but_kin, [&](int leaf) {
    const int* ids = tree.primitives(leaf);
    for (unsigned lanes = boxes.overlap_mask(tree.bound(0, leaf)); lanes != 0; lanes &= lanes - 1) {
      const int lane = std::countr_zero(lanes);
      unsigned hits = tree.boxes(0, leaf).overlap_mask(boxes.get(lane));
      hits &= (active >> lane & 1u) != 0 ? 0xffu : tree.active(0, leaf);
      if constexpr (Same) hits &= lanes_above(ids, queries.primitives(group)[lane]);
      rows[lane].append(ids, hits);
    }
  });
}

template <bool Same, class Relation>
void find_pairs(const Bvh& queries, const Bvh& tree, const Relation& relation,
                std::vector<std::array<int, 2>>& pairs) {
  pairs.clear();
  if (queries.size() == 0 || tree.size() == 0) return;
  constexpr int task_groups = 32;
  const int groups = queries.groups(0), tasks = (groups + task_groups - 1) / task_groups;
  std::vector<std::vector<int>> partners(tasks);
  std::vector<std::size_t> begin(queries.size() + 1, 0);  // first the counts, then the places
  const auto for_groups = [&](int task, const auto& visit) {
    for (int g = task * task_groups; g < std::min((task + 1) * task_groups, groups); ++g)
      visit(g, std::min(Box8::width, queries.size() - g * Box8::width));
  };

  for_each(tasks, [&](int task) {
    Rows rows;
    for_groups(task, [&](int group, int lanes) {
      int but_kin = -1;
      if constexpr (requires { relation.skips(but_kin); }) {
        if (const int kin = queries.kin(0, group); kin >= 0 && relation.skips(kin)) but_kin = kin;
        if (but_kin >= 0 && relation.alone(but_kin, queries.bound(0, group))) return;
      }
      search_group<Same>(queries, group, tree, but_kin, rows);
      for (int lane = 0; lane < lanes; ++lane) {
        const int query = queries.primitives(group)[lane];
        rows[lane].filter_and_sort(query, relation);
        begin[query + 1] = rows[lane].count;
        partners[task].insert(partners[task].end(), rows[lane].ids.begin(),
                              rows[lane].ids.begin() + rows[lane].count);
      }
    });
  }, 1);
  for (int query = 0; query < queries.size(); ++query) begin[query + 1] += begin[query];
  pairs.resize(begin.back());
  for_each(tasks, [&](int task) {
    auto partner = partners[task].begin();
    for_groups(task, [&](int group, int lanes) {
      for (int lane = 0; lane < lanes; ++lane) {
        const int query = queries.primitives(group)[lane];
        for (std::size_t k = begin[query]; k < begin[query + 1]; ++k)
          pairs[k] = relation.pair(query, *partner++);
      }
    });
  }, 1);
}

}  // namespace detail

// Pairs (q, t) of a primitive of `queries` and one of `tree`.
template <class Relation>
void overlap_pairs(const Bvh& queries, const Bvh& tree, const Relation& relation,
                   std::vector<std::array<int, 2>>& pairs) {
  detail::find_pairs<false>(queries, tree, relation, pairs);
}

// Pairs (q, t) with q < t of primitives of one tree.
template <class Relation>
void overlap_pairs(const Bvh& tree, const Relation& relation,
                   std::vector<std::array<int, 2>>& pairs) {
  detail::find_pairs<true>(tree, tree, relation, pairs);
}

}  // namespace tack
