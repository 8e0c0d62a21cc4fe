// The tables of summary.hpp.
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "framework/output/summary.hpp"

namespace tack {

std::string phase_table(const RunSummary& summary) {
  const PhaseClock::Seconds& seconds = summary.phases;
  const double total = std::accumulate(seconds.begin(), seconds.end(), 0.0);
  std::array<int, phase_count> order;
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](int a, int b) { return seconds[a] > seconds[b]; });
  std::string text = fmt::format("{:<14}{:>10}{:>7}\n", "phase", "seconds", "%");
  for (const int phase : order) {
    if (!(seconds[phase] > 0)) continue;
    const double fraction = seconds[phase] / total;
    const std::string bar(static_cast<std::size_t>(40 * fraction + 0.5), '#');
    const std::string row = fmt::format("{:<14}{:>10.3f}{:>7.1f}  {}", phase_names[phase],
                                        seconds[phase], 100 * fraction, bar);
    text += row.substr(0, row.find_last_not_of(' ') + 1) + "\n";
  }
  return text + fmt::format("{:<14}{:>10.3f}\n", "total", total);
}

std::string expect_table(const std::vector<ExpectationResult>& results) {
  std::size_t width = 0;
  for (const ExpectationResult& r : results) width = std::max(width, r.name.size());
  std::string text;
  for (const ExpectationResult& r : results) {
    text += fmt::format("{}  {:<{}}  {}\n", r.pass ? "pass" : "FAIL", r.name, width, r.text);
  }
  return text;
}

}  // namespace tack
