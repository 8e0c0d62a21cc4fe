#include "solvers/linear/task_graph.hpp"

#include <algorithm>
#include <numeric>

namespace tack {

int TaskGraph::add(double cost) {
  cost_.push_back(cost);
  start_.push_back(start_.back());
  return static_cast<int>(cost_.size()) - 1;
}

void TaskGraph::wait_for(int task) {
  before_.push_back(task);
  ++start_.back();
}

TaskGraph::Sorted TaskGraph::sort() const {
  const int count = static_cast<int>(cost_.size());
  std::vector<double> begin(count, 0.0), chain(cost_);  // chain: cost of the longest one that begins with the task
  for (int t = 0; t < count; ++t)
    for (int k = start_[t]; k < start_[t + 1]; ++k) begin[t] = std::max(begin[t], begin[before_[k]] + cost_[before_[k]]);
  for (int t = count - 1; t >= 0; --t)
    for (int k = start_[t]; k < start_[t + 1]; ++k) chain[before_[k]] = std::max(chain[before_[k]], cost_[before_[k]] + chain[t]);
  Sorted sorted;
  sorted.task.resize(count);
  std::iota(sorted.task.begin(), sorted.task.end(), 0);
  std::sort(sorted.task.begin(), sorted.task.end(), [&](int a, int b) {
    if (begin[a] != begin[b]) return begin[a] < begin[b];
    return chain[a] != chain[b] ? chain[a] > chain[b] : a < b;
  });
  std::vector<int> chunk_of(count);
  for (int c = 0; c < count; ++c) chunk_of[sorted.task[c]] = c;
  ChunkOrder& order = sorted.order;
  order.start.reserve(count + 1);
  order.before.reserve(before_.size());
  for (const int t : sorted.task) {
    for (int k = start_[t]; k < start_[t + 1]; ++k) order.before.push_back(chunk_of[before_[k]]);
    order.start.push_back(static_cast<int>(order.before.size()));
  }
  order.strip_start.resize(count + 1);
  std::iota(order.strip_start.begin(), order.strip_start.end(), 0);
  return sorted;
}

}  // namespace tack
