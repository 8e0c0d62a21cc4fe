// Performance profiles (Dolan and More 2002): rho_s(tau) is the fraction of tasks that solver s
// solves in at most tau times the time of the fastest solver.
// - rho_s(1): how often s is the fastest
// - rho_s at the largest tau: how often s succeeds
// A task is a problem with a tolerance and a time step.
#pragma once

#include "framework/compare/comparison.hpp"

namespace tack {

struct PerformanceProfile {
  std::string solver;
  std::vector<double> ratios;  // to the fastest time, ascending; infinity for failures
};

// Returns the profiles in the order in which the solvers first occur. Tasks that no solver solves
// count as failures of all.
std::vector<PerformanceProfile> performance_profiles(const std::vector<CompareRow>& rows);

}  // namespace tack
