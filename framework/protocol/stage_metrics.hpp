// The stage of a protocol as a step metric: a column of steps.csv, and of a probe of type step.
#pragma once

#include "framework/core/step_metric.hpp"
#include "framework/protocol/protocol_config.hpp"

namespace tack {

// stage: index from 0; the metric counts from 1. Its name is stage_NAME, with spaces as _.
inline StepMetric stage_metric(const ProtocolConfig& protocol, int stage) {
  std::string name = "stage_" + protocol.name;
  for (char& c : name)
    if (c == ' ') c = '_';
  return {name, stage + 1.0, StepMetric::RunValue::maximum};
}

}  // namespace tack
