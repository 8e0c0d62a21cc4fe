// Joins items whose boxes overlap into groups. A tree over the boxes leaves out pairs of nodes that
// are one group by then: items that all overlap take as many visits as there are items, times the
// levels of the tree, not one for each pair.
#pragma once

#include <Eigen/Geometry>

#include <algorithm>
#include <vector>

namespace tack {

class OverlapTree {
 public:
  using Boxes = std::vector<Eigen::AlignedBox3d>;

  // boxes: finite. items: indices of boxes.
  OverlapTree(const Boxes& boxes, std::vector<int> items)
      : boxes_(boxes), items_(std::move(items)) {
    if (items_.empty()) return;
    nodes_.push_back({{}, 0, static_cast<int>(items_.size())});
    for (size_t n = 0; n < nodes_.size(); ++n) divide(n);
  }

  // Calls join(a, b), which puts both items into one group, for overlapping items, until all that
  // overlap are in one group. group(a): the group of an item.
  template <class Group, class Join>
  void join_overlapping(const Group& group, const Join& join) {
    if (!nodes_.empty()) visit(0, 0, group, join);
  }

 private:
  static constexpr int leaf_size = 4;
  struct Node {
    Eigen::AlignedBox3d box;
    int first, last;      // in items_
    int children = -1;    // the first of two; -1: a leaf
    bool joined = false;  // all items are known to be in one group
  };

  void divide(size_t n) {
    const int first = nodes_[n].first, last = nodes_[n].last;
    Eigen::AlignedBox3d centres;
    for (int i = first; i < last; ++i) {
      nodes_[n].box.extend(boxes_[items_[i]]);
      centres.extend(boxes_[items_[i]].center());
    }
    if (last - first <= leaf_size) return;
    int axis = 0;
    centres.sizes().maxCoeff(&axis);
    const int middle = (first + last) / 2;
    std::nth_element(
        items_.begin() + first, items_.begin() + middle, items_.begin() + last,
        [&](int a, int b) { return boxes_[a].center()[axis] < boxes_[b].center()[axis]; });
    nodes_[n].children = static_cast<int>(nodes_.size());
    nodes_.push_back({{}, first, middle});
    nodes_.push_back({{}, middle, last});
  }

  template <class Group>
  bool joined(int n, const Group& group) {
    Node& node = nodes_[n];
    if (node.joined) return true;
    if (node.children >= 0) {
      node.joined = joined(node.children, group) && joined(node.children + 1, group) &&
                    group(items_[node.first]) == group(items_[node.last - 1]);
    } else {
      node.joined = std::all_of(items_.begin() + node.first, items_.begin() + node.last,
                                [&](int i) { return group(i) == group(items_[node.first]); });
    }
    return node.joined;
  }

  template <class Group, class Join>
  void visit(int a, int b, const Group& group, const Join& join) {
    if (!nodes_[a].box.intersects(nodes_[b].box)) return;
    if (joined(a, group) && joined(b, group) &&
        group(items_[nodes_[a].first]) == group(items_[nodes_[b].first]))
      return;
    const int of_a = nodes_[a].children, of_b = nodes_[b].children;
    if (a == b && of_a >= 0) {
      visit(of_a, of_a, group, join);
      visit(of_a + 1, of_a + 1, group, join);
      visit(of_a, of_a + 1, group, join);
    } else if (of_a >= 0 &&
               (of_b < 0 || nodes_[a].last - nodes_[a].first >= nodes_[b].last - nodes_[b].first)) {
      visit(of_a, b, group, join);
      visit(of_a + 1, b, group, join);
    } else if (of_b >= 0) {
      visit(a, of_b, group, join);
      visit(a, of_b + 1, group, join);
    } else {
      for (int i = nodes_[a].first; i < nodes_[a].last; ++i)
        for (int j = nodes_[b].first; j < nodes_[b].last; ++j)
          if (items_[i] != items_[j] && boxes_[items_[i]].intersects(boxes_[items_[j]]))
            join(items_[i], items_[j]);
    }
  }

  const Boxes& boxes_;
  std::vector<int> items_;
  std::vector<Node> nodes_;
};

}  // namespace tack
