// Limit of the processor time of a solve.
#pragma once

#include <atomic>
#include <optional>
#include <thread>

namespace tack {

/// Returns the processor time of all threads of this process so far [s].
double cpu_now();

/// Requests an interrupt (geometry/interrupt.hpp) once this process has used that much more
/// processor time. Minimisers end at their next iteration. The destructor withdraws the request.
class CpuLimit {
 public:
  /// seconds: none: no limit.
  explicit CpuLimit(std::optional<double> seconds);
  ~CpuLimit();
  CpuLimit(const CpuLimit&) = delete;
  CpuLimit& operator=(const CpuLimit&) = delete;

  /// Returns whether this limit requested the interrupt.
  bool passed() const { return passed_; }

 private:
  std::atomic<bool> passed_ = false, ended_ = false;
  std::thread watch_;
};

}  // namespace tack
