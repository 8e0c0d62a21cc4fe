// compare.md: the setting of the comparison, results of all tasks together, the fastest solver at
// each level of error, and the failures.
#pragma once

#include "framework/compare/comparison.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

// Writes the report as Markdown. wall_seconds: of the whole comparison.
std::string compare_report(const CompareConfig& config, const Comparison& comparison,
                           const Provenance& provenance, double wall_seconds);

}  // namespace tack
