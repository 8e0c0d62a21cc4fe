// Limits the number of threads to that of the command line, during the lifetime of the object.
#pragma once

#include <tbb/global_control.h>
#include <tbb/info.h>

namespace tack {

class ThreadLimit {
 public:
  // wanted: number of threads; 0: all cores.
  explicit ThreadLimit(int wanted)
      : count_(wanted > 0 ? wanted : tbb::info::default_concurrency()),
        control_(tbb::global_control::max_allowed_parallelism, static_cast<size_t>(count_)) {}

  int count() const { return count_; }

 private:
  int count_;
  tbb::global_control control_;
};

}  // namespace tack
