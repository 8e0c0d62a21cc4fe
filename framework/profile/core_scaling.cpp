#include "framework/profile/core_scaling.hpp"

#include <algorithm>

namespace tack {
namespace {

template <class Take>
double sum_of(const std::vector<LoopCost>& costs, const Take& take) {
  double sum = 0;
  for (const LoopCost& cost : costs) sum += take(cost);
  return sum;
}

double ratio(double one, double many) { return many > 0 ? one / many : 1; }

}  // namespace

size_t CoreScaling::index_of_asked() const {
  return std::find(cores.begin(), cores.end(), asked) - cores.begin();
}

double CoreScaling::seconds() const {
  return sum_of(costs, [](const LoopCost& c) { return c.seconds; });
}

double CoreScaling::serial_seconds() const {
  return sum_of(costs, [](const LoopCost& c) { return c.undivided; });
}

double CoreScaling::seconds(Phase phase) const {
  return sum_of(costs, [&](const LoopCost& c) { return c.phase == phase ? c.seconds : 0; });
}

double CoreScaling::serial_seconds(Phase phase) const {
  return sum_of(costs, [&](const LoopCost& c) { return c.phase == phase ? c.undivided : 0; });
}

long CoreScaling::divided_runs() const {
  long runs = 0;
  for (const LoopCost& cost : costs) runs += cost.divided_runs;
  return runs;
}

double CoreScaling::speed_up(size_t k) const {
  return ratio(seconds(), sum_of(costs, [&](const LoopCost& c) { return c.on_cores[k]; }));
}

double CoreScaling::speed_up(size_t k, Phase phase) const {
  return ratio(seconds(phase), sum_of(costs, [&](const LoopCost& c) { return c.phase == phase ? c.on_cores[k] : 0; }));
}

double CoreScaling::speed_up_of_loops(size_t k) const {
  return ratio(seconds() - serial_seconds(),
               sum_of(costs, [&](const LoopCost& c) { return c.on_cores[k] - c.undivided; }));
}

double CoreScaling::share_lost(const LoopCost& cost) const {
  const size_t k = index_of_asked();
  const double all = sum_of(costs, [&](const LoopCost& c) { return c.lost(k, asked); });
  return all > 0 ? cost.lost(k, asked) / all : 0;
}

void CoreScaling::sort() {
  const size_t k = index_of_asked();
  std::stable_sort(costs.begin(), costs.end(), [&](const LoopCost& a, const LoopCost& b) {
    return a.lost(k, asked) > b.lost(k, asked);
  });
}

}  // namespace tack
