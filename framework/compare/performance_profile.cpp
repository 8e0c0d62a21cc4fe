#include "framework/compare/performance_profile.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <tuple>

namespace tack {

std::vector<PerformanceProfile> performance_profiles(const std::vector<CompareRow>& rows) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  using Task = std::tuple<std::string, double, double>;
  const auto task_of = [](const CompareRow& r) { return Task(r.problem, r.tolerance, r.time_step); };
  std::map<Task, double> fastest;
  for (const CompareRow& r : rows) {
    if (!r.solved()) continue;
    const auto [at, first] = fastest.emplace(task_of(r), r.wall_seconds);
    if (!first) at->second = std::min(at->second, r.wall_seconds);
  }
  std::vector<PerformanceProfile> profiles;
  for (const CompareRow& r : rows) {
    const auto best = fastest.find(task_of(r));  // end if no solver solved it
    auto profile = std::find_if(profiles.begin(), profiles.end(), [&](const PerformanceProfile& p) { return p.solver == r.solver; });
    if (profile == profiles.end()) profile = profiles.insert(profile, {r.solver, {}});
    profile->ratios.push_back(r.solved() ? r.wall_seconds / best->second : infinity);
  }
  for (PerformanceProfile& p : profiles) std::sort(p.ratios.begin(), p.ratios.end());
  return profiles;
}

}  // namespace tack
