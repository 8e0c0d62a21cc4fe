// The stage of a protocol as a step metric: a column of steps.csv, and of a probe of type step.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>

#include "framework/core/step_metric.hpp"
#include "framework/protocol/protocol_config.hpp"

namespace tack {

inline constexpr std::string_view stage_prefix = "stage_";

// Returns the name of a protocol as it stands in columns: with spaces as _.
inline std::string column_name(std::string protocol) {
  std::replace(protocol.begin(), protocol.end(), ' ', '_');
  return protocol;
}

// stage: index from 0; the metric counts from 1. Its name is stage_NAME.
inline StepMetric stage_metric(const ProtocolConfig& protocol, int stage) {
  return {std::string(stage_prefix) + column_name(protocol.name), stage + 1.0,
          StepMetric::RunValue::maximum};
}

}  // namespace tack
