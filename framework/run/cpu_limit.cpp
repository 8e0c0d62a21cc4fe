#include "framework/run/cpu_limit.hpp"

#include <chrono>
#include <ctime>

#include "geometry/interrupt.hpp"

namespace tack {
namespace {

constexpr std::chrono::milliseconds watch_interval{10};

}  // namespace

double cpu_now() {
  timespec t{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

CpuLimit::CpuLimit(std::optional<double> seconds) {
  if (!seconds) return;
  watch_ = std::thread([this, end = cpu_now() + *seconds] {
    while (!ended_) {
      if (cpu_now() >= end && !interrupt_requested.exchange(true)) passed_ = true;
      if (interrupt_requested) return;
      std::this_thread::sleep_for(watch_interval);
    }
  });
}

CpuLimit::~CpuLimit() {
  ended_ = true;
  if (watch_.joinable()) watch_.join();
  if (passed_) interrupt_requested = false;
}

}  // namespace tack
