// Plots of a comparison: work_precision (time against error), performance_profile, and convergence
// (residual against iterations).
#pragma once

#include <filesystem>

#include "framework/compare/comparison.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

// Plots time against error. Several problems make one curve: the sum of their times against the
// geometric mean of their errors, relative to the size of the moving objects. Only problems count
// that every solver solves at some tolerance, but for solvers that solve none. A tolerance at which
// one of these problems fails has no point.
Plot work_precision(const std::vector<CompareRow>& rows);
Plot profile_plot(const std::vector<CompareRow>& rows);
Plot convergence_plot(const Comparison& comparison);

// Draws all plots into folder/plots. Returns the error messages.
std::vector<std::string> draw_plots(const Comparison& comparison,
                                    const std::filesystem::path& folder);

}  // namespace tack
