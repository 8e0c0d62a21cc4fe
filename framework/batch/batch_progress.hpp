// Progress of a batch. On a terminal, a block that is rewritten: counts of finished, running and
// failed cases, remaining time, and a line for each running case. Elsewhere, and above the block, a
// line for each case that ends.
#pragma once

#include <chrono>
#include <ostream>

#include "framework/batch/batch_run.hpp"

namespace tack {

class BatchProgress {
 public:
  // cases: of the plan. open: cases that are to run. live_width: columns of the terminal, 0 for
  // none.
  BatchProgress(std::ostream& out, size_t cases, size_t open, int jobs, int live_width, bool quiet);
  ~BatchProgress();  // takes the block away

  BatchObserver observer();

 private:
  void ended(const BatchCase& one, const CaseState& state);
  void tick(const std::vector<BatchObserver::Running>& running, size_t waiting);
  void erase();
  double seconds() const;

  std::ostream& out_;
  size_t cases_, open_, ended_ = 0, failed_ = 0;
  int jobs_, live_width_;
  bool quiet_;
  int lines_ = 0;      // of the block on the terminal
  double shown_ = -1;  // s
  std::chrono::steady_clock::time_point begun_ = std::chrono::steady_clock::now();
};

// Formats a duration: "0.2s", "12s", "2m05s"; with tenths below ten seconds.
std::string short_duration(double seconds);

}  // namespace tack
