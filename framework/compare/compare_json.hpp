// compare.json: provenance and references of the numbers in compare.csv.
//
// Keys:
// - name, about, repeat, wall_seconds [s]
// - provenance {...}: output/provenance_json.hpp
// - references [{problem, time_step [s], unknowns, size [m], tolerance [m/s] (null: none was
//   found), disagreement [m], different_solutions, status}]
#pragma once

#include "framework/compare/comparison.hpp"
#include "framework/output/provenance.hpp"

namespace tack {

std::string compare_json(const CompareConfig& config, const Comparison& comparison,
                         const Provenance& provenance, double wall_seconds);

}  // namespace tack
