// Finds all overlapping pairs between the primitives of two trees, sorted. The result does not
// depend on the number of threads.
//
// Key idea: queries are processed eight at a time (a group of the query tree). Their common bound
// descends the other tree once; at a leaf group, each query that overlaps it is tested against its
// eight boxes at once. The hits of a query are first collected, then filtered and sorted in loops
// without branches. Tasks are fixed runs of query groups with a list of their own; finally the
// partners of every query are copied to the position given by a prefix sum over the queries.
//
// `Relation` is plain data with two inlined members, for query q and primitive t:
//   bool accept(int q, int t) const             whether the overlapping pair is accepted
//   std::array<int, 2> pair(int q, int t) const the pair to write
// and, if it may refuse pairs within a rigid group (bvh.hpp),
//   bool skips(int rigid_group) const           whether it refuses all pairs within this group
//   bool isolated(int rigid_group, const Aabb& box) const
//                                               whether no other object overlaps the box
// The result is ordered by q, then t.
#pragma once

#include <array>
#include <bit>
#include <vector>

#include "geometry/broad_phase/bvh.hpp"
#include "geometry/broad_phase/lanes.hpp"
#include "geometry/parallel.hpp"
#include "geometry/prefix_sums.hpp"

namespace tack {
namespace detail {

// Calls visit(leaf group) for the groups of the tree that may hold partners of the box. If
// `only_active`, subtrees without an active primitive are skipped; so are subtrees that hold only
// primitives of the rigid group `except_group` (-1: none).
template <class Visit>
void visit_groups(const Bvh& tree, const Aabb& box, bool only_active, int except_group,
                  const Visit& visit) {
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
      if (except_group < 0 || tree.rigid_group(level - 1, child) != except_group)
        stack[top++] = {level - 1, child};
    }
  }
}

// The primitives that one query hits; the buffer never shrinks.
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

// Finds the hits of a group of queries. With Same, queries and tree are one tree, and only pairs
// q < t are found. Subtrees of the rigid group `except_group` are skipped (-1: none).
template <bool Same>
void search_group(const Bvh& queries, int group, const Bvh& tree, int except_group, Rows& rows) {
  const Box8& boxes = queries.boxes(0, group);
  const unsigned active = queries.active(0, group);
  for (Row& row : rows) row.count = 0;
  visit_groups(tree, queries.bound(0, group), active == 0, except_group, [&](int leaf) {
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
  constexpr int task_groups = 16;
  const int groups = queries.groups(0), tasks = (groups + task_groups - 1) / task_groups;
  std::vector<std::vector<int>> partners(tasks);
  std::vector<std::size_t> begin(queries.size() + 1, 0);  // first counts, then offsets
  const auto for_groups = [&](int task, const auto& visit) {
    for (int g = task * task_groups; g < std::min((task + 1) * task_groups, groups); ++g)
      visit(g, std::min(Box8::width, queries.size() - g * Box8::width));
  };

  for_each(
      tasks,
      [&](int task) {
        Rows rows;
        for_groups(task, [&](int group, int lanes) {
          int except_group = -1;
          if constexpr (requires { relation.skips(except_group); }) {
            if (const int own = queries.rigid_group(0, group); own >= 0 && relation.skips(own))
              except_group = own;
            if (except_group >= 0 && relation.isolated(except_group, queries.bound(0, group)))
              return;
          }
          search_group<Same>(queries, group, tree, except_group, rows);
          for (int lane = 0; lane < lanes; ++lane) {
            const int query = queries.primitives(group)[lane];
            rows[lane].filter_and_sort(query, relation);
            begin[query + 1] = rows[lane].count;
            partners[task].insert(partners[task].end(), rows[lane].ids.begin(),
                                  rows[lane].ids.begin() + rows[lane].count);
          }
        });
      },
      1);
  prefix_sums(begin);
  pairs.resize(begin.back());
  for_each(
      tasks,
      [&](int task) {
        auto partner = partners[task].begin();
        for_groups(task, [&](int group, int lanes) {
          for (int lane = 0; lane < lanes; ++lane) {
            const int query = queries.primitives(group)[lane];
            for (std::size_t k = begin[query]; k < begin[query + 1]; ++k)
              pairs[k] = relation.pair(query, *partner++);
          }
        });
      },
      1);
}

}  // namespace detail

// Finds pairs (q, t) of a primitive of `queries` and a primitive of `tree`.
template <class Relation>
void overlap_pairs(const Bvh& queries, const Bvh& tree, const Relation& relation,
                   std::vector<std::array<int, 2>>& pairs) {
  detail::find_pairs<false>(queries, tree, relation, pairs);
}

// Finds pairs (q, t) with q < t of primitives of one tree.
template <class Relation>
void overlap_pairs(const Bvh& tree, const Relation& relation,
                   std::vector<std::array<int, 2>>& pairs) {
  detail::find_pairs<true>(tree, tree, relation, pairs);
}

}  // namespace tack
