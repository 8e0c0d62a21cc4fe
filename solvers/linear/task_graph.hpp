// Tasks with costs that wait for each other, in an order for many threads.
#pragma once

#include <vector>

#include "geometry/chunk_order.hpp"

namespace tack {

class TaskGraph {
 public:
  // Adds a task and returns its number. cost: of any unit, positive.
  int add(double cost);
  // The task that was added last waits for an earlier one.
  void wait_for(int task);

  struct Sorted {
    std::vector<int> task;  // numbers, in the order of the chunks
    ChunkOrder order;       // each chunk is a strip
  };
  // Returns the tasks by the time at which they could begin on any number of cores. Of tasks that
  // could begin at once, the first is the one with the most expensive chain of tasks after it.
  Sorted sort() const;

 private:
  std::vector<double> cost_;
  std::vector<int> start_ = {0};  // first entry of each task in `before_`, and the end
  std::vector<int> before_;
};

}  // namespace tack
