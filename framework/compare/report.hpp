// compare.md: what was measured on what, what solvers do in all tasks together, the fastest at each level of error, and what failed.
#pragma once

#include "framework/compare/comparison.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

// `wall_seconds`: of it all.
std::string compare_report(const CompareConfig& config, const Comparison& comparison, const Provenance& provenance,
                           double wall_seconds);

}  // namespace tack
