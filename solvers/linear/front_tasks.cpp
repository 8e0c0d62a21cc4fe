#include "solvers/linear/front_tasks.hpp"

#include "solvers/linear/supernode_tree.hpp"
#include "solvers/linear/task_graph.hpp"

namespace tack {
namespace {

using TaskKind = FrontTask::Kind;

// Work of nodes that are not cut into tiles: products and sums of a factorisation (50 us), and
// entries read by a solve (3 us).
constexpr double whole_work_max = 1e6;
constexpr std::ptrdiff_t whole_entries_max = 1 << 13;
// Costs in products and sums (0.034 ns): of a task without work, of an entry that is set to zero and
// added to, and of one that a solve reads.
constexpr double task_cost = 5000, entry_cost = 30, read_cost = 10;

// Adds the tasks of a tree to a graph.
class TaskBuilder {
 public:
  explicit TaskBuilder(const SupernodeTree& tree) : tree_(tree), done_(tree.nodes()), back_done_(tree.nodes(), -1) {}

  FrontTasks factorisation() {
    add_subtrees(TaskKind::subtree, [&](int i) { return tree_.subtrees[i].work; });
    for (const int s : tree_.top) {
      const double columns = tree_.columns(s), height = tree_.height(s), work = height * height * columns;
      if (work <= whole_work_max) {
        done_[s] = {add({TaskKind::whole, s}, work + entry_cost / 2 * height * height)};
        wait_for_children(s);
      } else {
        factorise_tiles(s, FrontTiles::of_factor(tree_.columns(s), tree_.height(s)));
      }
    }
    return sorted();
  }

  FrontTasks solve() {
    add_subtrees(TaskKind::subtree, [&](int i) { return read_cost * static_cast<double>(entries_of(i)); });
    for (const int s : tree_.top) {
      if (whole_in_solve(s)) {
        done_[s] = {add({TaskKind::whole, s}, read_cost * static_cast<double>(entries(s)))};
        wait_for_children(s);
      } else {
        forward_tiles(s, FrontTiles::of_solve(tree_.columns(s), tree_.height(s)));
      }
    }
    for (auto s = tree_.top.rbegin(); s != tree_.top.rend(); ++s) {
      if (whole_in_solve(*s)) {
        back_done_[*s] = add({TaskKind::whole_back, *s}, read_cost * static_cast<double>(entries(*s)));
        wait_for_solution(*s);
      } else {
        backward_tiles(*s, FrontTiles::of_solve(tree_.columns(*s), tree_.height(*s)));
      }
    }
    for (int i = 0; i < static_cast<int>(tree_.subtrees.size()); ++i) {
      add({TaskKind::subtree_back, i}, read_cost * static_cast<double>(entries_of(i)));
      wait_for_solution(tree_.subtrees[i].root);
    }
    return sorted();
  }

 private:
  int add(const FrontTask& task, double cost) {
    tasks_.push_back(task);
    return graph_.add(cost + task_cost);
  }

  template <class Cost>
  void add_subtrees(TaskKind kind, const Cost& cost) {
    for (int i = 0; i < static_cast<int>(tree_.subtrees.size()); ++i)
      done_[tree_.subtrees[i].root] = {add({kind, i}, cost(i))};
  }

  // The last task waits for the contributions of the node's children.
  void wait_for_children(int s) {
    for (int k = tree_.child_start[s]; k < tree_.child_start[s + 1]; ++k)
      for (const int task : done_[tree_.children[k]]) graph_.wait_for(task);
  }
  // The last task waits for the solution in the rows below, or, in a root, for the forward solve.
  void wait_for_solution(int s) {
    if (tree_.parent[s] >= 0) return graph_.wait_for(back_done_[tree_.parent[s]]);
    for (const int task : done_[s]) graph_.wait_for(task);
  }

  void factorise_tiles(int s, const FrontTiles& tiles) {
    const auto area = [&](int i, int j) { return double(tiles.end(i) - tiles.begin(i)) * (tiles.end(j) - tiles.begin(j)); };
    const int begin = add({TaskKind::begin, s}, 0);
    wait_for_children(s);
    std::vector<int> opened(tiles.count);
    for (int j = 0; j < tiles.count; ++j) {
      opened[j] = add({TaskKind::open, s, 0, j}, entry_cost * (tiles.height - tiles.begin(j)) * (tiles.end(j) - tiles.begin(j)));
      graph_.wait_for(begin);
    }
    add({TaskKind::release, s}, 0);
    for (const int task : opened) graph_.wait_for(task);
    std::vector<int> left(tiles.count);  // the last task of each row of tiles
    for (int j = 0; j < tiles.own; ++j)
      for (int i = j; i < tiles.count; ++i) {
        const int task = add({TaskKind::panel, s, i, j}, area(i, j) * tiles.end(j));
        graph_.wait_for(i == j ? opened[j] : left[j]);
        if (j > 0) graph_.wait_for(left[i]);
        left[i] = task;
      }
    done_[s].clear();
    for (int j = tiles.own; j < tiles.count; ++j)
      for (int i = j; i < tiles.count; ++i) {
        done_[s].push_back(add({TaskKind::update, s, i, j}, area(i, j) * tiles.columns));
        graph_.wait_for(opened[j]);
        graph_.wait_for(left[i]);
        if (i != j) graph_.wait_for(left[j]);
      }
    if (done_[s].empty()) done_[s] = {left[tiles.own - 1]};
  }

  void forward_tiles(int s, const FrontTiles& tiles) {
    std::vector<int> left(tiles.own, add({TaskKind::gather, s}, read_cost * tiles.height));
    wait_for_children(s);
    for (int j = 0; j < tiles.own; ++j)
      for (int i = j; i < tiles.own; ++i) {
        const int task = add({TaskKind::lower, s, i, j}, read_cost * tiles.own_width * tiles.own_width);
        graph_.wait_for(left[i]);
        if (i != j) graph_.wait_for(left[j]);
        left[i] = task;
      }
    done_[s].clear();
    for (int i = tiles.own; i < tiles.count; ++i) {
      done_[s].push_back(add({TaskKind::subtract, s, i}, read_cost * tiles.below_width * tiles.columns));
      graph_.wait_for(left[tiles.own - 1]);
    }
    if (done_[s].empty()) done_[s] = {left[tiles.own - 1]};
  }

  void backward_tiles(int s, const FrontTiles& tiles) {
    const int scattered = add({TaskKind::scatter, s}, read_cost * tiles.height);
    wait_for_solution(s);
    std::vector<int> left(tiles.own);
    for (int j = tiles.own - 1; j >= 0; --j) {
      left[j] = add({TaskKind::transposed_below, s, 0, j}, read_cost * tiles.own_width * (tiles.height - tiles.columns));
      graph_.wait_for(scattered);
    }
    for (int i = tiles.own - 1; i >= 0; --i)
      for (int j = i; j >= 0; --j) {
        const int task = add({TaskKind::transposed, s, i, j}, read_cost * tiles.own_width * tiles.own_width);
        graph_.wait_for(left[j]);
        if (i != j) graph_.wait_for(left[i]);
        left[j] = task;
      }
    back_done_[s] = left[0];
  }

  std::ptrdiff_t entries(int s) const { return tree_.panel[s + 1] - tree_.panel[s]; }
  std::ptrdiff_t entries_of(int i) const {
    return tree_.panel[tree_.subtrees[i].root + 1] - tree_.panel[tree_.subtrees[i].first];
  }
  bool whole_in_solve(int s) const { return entries(s) <= whole_entries_max; }

  FrontTasks sorted() const {
    TaskGraph::Sorted sorted = graph_.sort();
    FrontTasks result{{}, std::move(sorted.order)};
    for (const int t : sorted.task) result.tasks.push_back(tasks_[t]);
    return result;
  }

  const SupernodeTree& tree_;
  TaskGraph graph_;
  std::vector<FrontTask> tasks_;
  std::vector<std::vector<int>> done_;  // tasks after which the contribution of each node is complete
  std::vector<int> back_done_;          // task after which the solution of each node is complete
};

}  // namespace

FrontTasks tasks_of_factorisation(const SupernodeTree& tree) { return TaskBuilder(tree).factorisation(); }
FrontTasks tasks_of_solve(const SupernodeTree& tree) { return TaskBuilder(tree).solve(); }

}  // namespace tack
