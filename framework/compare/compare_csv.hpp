// compare.csv: a row for each combination of problem, solver, tolerance and time step. Unknown
// values are empty. Columns:
// - problem, solver, tolerance [m/s], time_step [s]
// - wall_seconds (median), wall_spread (largest - smallest), cpu_seconds (median)
// - iterations, evaluations, linear_solves, status
// - branch: same, equal, another, inaccurate; empty: unknown
// - error_rms, error_max [m], relative_error (error_max over the size of the moving objects)
// - error_floor (RMS [m]): the distance of the two references; smaller errors are noise
// - energy_gap [J], intersections (of the last state)
// - penetration [m], crossing_pairs: the maxima over the steps, for steppers that let surfaces pass
//   through each other
// - error_<column> for each column of the probes
#pragma once

#include <filesystem>

#include "framework/compare/comparison.hpp"

namespace tack {

void write_compare_csv(const std::filesystem::path& path, const std::vector<CompareRow>& rows);

}  // namespace tack
