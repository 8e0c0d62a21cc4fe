#include "framework/output/probe_set.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

#include "framework/config/bind.hpp"
#include "framework/core/state.hpp"
#include "framework/output/derived_probe.hpp"
#include "framework/setup/build_world.hpp"

namespace tack {

ProbeSet::ProbeSet(const std::vector<std::unique_ptr<const Probe>>& specified, const Value& root, const World& world) {
  for (size_t i = 0; i < specified.size(); ++i) {
    Probe& probe = *probes_.emplace_back(instance_of(*specified[i]));
    try {
      probe.prepare(world);
      if (auto* derived = dynamic_cast<DerivedProbe*>(&probe)) derived->find(columns_);
    } catch (const InputError& error) {
      throw InputError(source_location(root, "probes", i) + error.what());
    }
    const bool derived = dynamic_cast<DerivedProbe*>(&probe);
    const bool unbounded = probe.unbounded() || (derived && std::find(unbounded_.begin(), unbounded_.end(), 1) != unbounded_.end());
    const auto more = probe.columns();
    columns_.insert(columns_.end(), more.begin(), more.end());
    units_.resize(units_.size() + more.size(), probe.unit());
    unbounded_.resize(units_.size(), unbounded);
  }
  reported_.resize(units_.size(), 0);
}

void ProbeSet::check(const std::vector<Expectation>& expectations, const Value& root) const {
  std::vector<std::string> columns = {"time"};
  std::vector<Unit> of_columns = {units::time};
  columns.insert(columns.end(), columns_.begin(), columns_.end());
  of_columns.insert(of_columns.end(), units_.begin(), units_.end());
  for (size_t i = 0; i < expectations.size(); ++i) {
    try {
      check_columns(expectations[i], columns);
      check_units(expectations[i], columns, of_columns);
    } catch (const InputError& error) {
      throw InputError(source_location(root, "expect", i) + error.what());
    }
  }
}

std::vector<double> ProbeSet::sample(const World& world, const State& state) {
  std::vector<double> values{state.time};
  for (const auto& probe : probes_) {
    const auto* derived = dynamic_cast<const DerivedProbe*>(probe.get());
    const auto more = derived ? std::vector<double>{derived->of(values)} : probe->sample(world, state);
    values.insert(values.end(), more.begin(), more.end());
  }
  values.erase(values.begin());
  for (size_t i = 0; i < values.size(); ++i) {
    if (std::isfinite(values[i]) || (std::isinf(values[i]) && unbounded_[i]) || std::exchange(reported_[i], 1)) continue;
    invalid_.push_back(fmt::format("{} is {}", columns_[i], values[i]));
  }
  return values;
}

std::vector<std::string> ProbeSet::take_invalid() { return std::exchange(invalid_, {}); }

}  // namespace tack
