// Probe of the stage of a protocol: its number, from 1, in the last step.
#include <fmt/format.h>

#include <algorithm>

#include "framework/config/nearest.hpp"
#include "framework/output/probe.hpp"
#include "framework/protocol/stage_metrics.hpp"
#include "framework/world/world.hpp"
#include "geometry/errors.hpp"

namespace tack {
namespace {

class StageProbe : public Probe {
 public:
  void fields(Fields& f) override {
    Probe::fields(f);
    f.text("protocol", protocol_, "name of the protocol; not needed if the scene has one");
  }
  void prepare(const World& world) override {
    std::vector<std::string> names;
    for (size_t i = 0; i < world.step_metrics.size(); ++i) {
      const std::string& metric = world.step_metrics[i].name;
      if (!metric.starts_with(stage_prefix)) continue;
      names.push_back(metric.substr(stage_prefix.size()));
      at_ = i;
    }
    if (names.empty()) throw InputError(fmt::format("probe '{}': the scene has no protocol; remove the probe", name_));
    const std::string wanted = column_name(protocol_);
    if (wanted.empty() && names.size() == 1) return;
    const auto found = std::find(names.begin(), names.end(), wanted);
    if (found == names.end()) throw InputError(fmt::format("probe '{}': there is no protocol '{}'{}", name_, protocol_, suggestion(wanted, names, "protocols")));
    at_ = at_ + 1 - names.size() + static_cast<size_t>(found - names.begin());
  }
  Unit unit() const override { return units::none; }
  std::vector<double> sample(const World& world, const State&) override { return {world.step_metrics[at_].value}; }

 private:
  std::string protocol_;
  size_t at_ = 0;
};

TACK_REGISTER(Probe, StageProbe, "stage", "Stage of a protocol in the last step: 1 for the first one.", "");

}  // namespace
}  // namespace tack
