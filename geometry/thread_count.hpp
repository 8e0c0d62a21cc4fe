// Number of threads that a parallel loop may use.
#pragma once

#include <tbb/global_control.h>
#include <tbb/task_arena.h>

#include <algorithm>

namespace tack {

/// Returns the largest number of threads that may run: an arena does not know the limit of a run.
inline int thread_count() {
  const auto limit =
      tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism);
  return std::min(tbb::this_task_arena::max_concurrency(), static_cast<int>(limit));
}

}  // namespace tack
