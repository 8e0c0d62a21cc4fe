// Performance profiles (Dolan and More 2002): rho_s(tau) is the part of all tasks that solver s does in at
// most tau times the time of the fastest. rho_s(1) tells how often s is the fastest, the right end
// how often it succeeds. A task is a problem with a tolerance and a time step.
#pragma once

#include "framework/compare/comparison.hpp"

namespace tack {

struct PerformanceProfile {
  std::string solver;
  std::vector<double> ratios;  // to the fastest, ascending; infinity where it failed
};

// In the order in which the solvers first occur. Tasks that nobody solves count as failed by all.
std::vector<PerformanceProfile> performance_profiles(const std::vector<CompareRow>& rows);

}  // namespace tack
