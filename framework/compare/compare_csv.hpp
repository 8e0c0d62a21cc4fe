// compare.csv: a row per combination. Columns: problem, solver, tolerance [m/s], time_step [s],
// wall_seconds (median), wall_spread (largest - smallest), cpu_seconds (median), iterations,
// evaluations, linear_solves, status, branch (same, equal, another, inaccurate; empty: not known), error_rms,
// error_max [m], relative_error (error_max over the size of what moves), error_floor (RMS [m]; what the two
// references are apart: smaller errors are noise), energy_gap [J], intersections (of the last state), penetration [m] and crossing_pairs (the most
// of any step, of steppers that let surfaces pass through each other), error_<column> for each column of the probes. What there is not is empty.
#pragma once

#include <filesystem>

#include "framework/compare/comparison.hpp"

namespace tack {

void write_compare_csv(const std::filesystem::path& path, const std::vector<CompareRow>& rows);

}  // namespace tack
