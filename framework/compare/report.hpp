// compare.md: what was measured on what, the fastest solver at each level of error, and what failed.
#pragma once

#include "framework/compare/comparison.hpp"

namespace tack {

struct MeasuredOn {
  std::string program, commit, machine;
  int threads = 0;
  double wall_seconds = 0;  // of it all
};

std::string compare_report(const CompareConfig& config, const Comparison& comparison, const MeasuredOn& on);

// "Intel(R) Xeon(R) ..., 2 cores": from /proc/cpuinfo.
std::string machine_name();

}  // namespace tack
