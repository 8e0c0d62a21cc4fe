// Probe of step metrics of the stepper.
#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class StepProbe : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("figure", metric_, "column of the stepper in steps.csv; lcp_pgs: sweeps, rows, row_residual [m/s], penetration [m] or crossing_pairs; path_following: load_time [s], path_work [J], load_steps or negative_pivots").required();
  }
  void prepare(const World& world) override {
    std::vector<std::string> names;
    for (const StepMetric& metric : world.step_metrics) names.push_back(metric.name);
    if (names.empty()) throw InputError(fmt::format("probe '{}': the scene's stepper reports no step metrics; remove the probe", name_));
    at_ = std::find(names.begin(), names.end(), metric_) - names.begin();
    if (at_ == names.size())
      throw InputError(fmt::format("probe '{}': the stepper reports no metric named '{}'{}", name_, metric_, suggestion(metric_, names, "figures")));
  }
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World& world, const State&) override { return {world.step_metrics[at_].value}; }

 private:
  std::string metric_;
  size_t at_ = 0;
};

TACK_REGISTER(Probe, StepProbe, "step", "A metric that the stepper reports of the last step (lcp_pgs: number of crossing surfaces, penetration; path_following: load time) "
                                        "[SI]; 0 before the first step.", "");

}  // namespace
}  // namespace tack
