// SI units of the columns of probes.csv, for axes and legends.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "framework/output/probe.hpp"

namespace tack {

// Returns the units by column, without time (seconds).
inline std::map<std::string, std::string> probe_units(
    const std::vector<std::unique_ptr<const Probe>>& probes) {
  std::map<std::string, std::string> units;
  for (const auto& probe : probes)
    for (const std::string& column : probe->columns()) units[column] = probe->unit().si;
  return units;
}

}  // namespace tack
