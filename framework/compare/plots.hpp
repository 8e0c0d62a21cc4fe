// The pictures of a comparison: work_precision (time against error), performance_profile and convergence
// (residual against iterations).
#pragma once

#include <filesystem>

#include "framework/compare/comparison.hpp"
#include "framework/plot/plot.hpp"

namespace tack {

// Several problems are one curve: the sum of their times against the geometric mean of their errors,
// relative to the size of what moves; a tolerance at which one of them fails has no point.
Plot work_precision(const std::vector<CompareRow>& rows);
Plot profile_plot(const std::vector<CompareRow>& rows);
Plot convergence_plot(const Comparison& comparison);

// All of them into folder/plots. What could not be drawn, and why.
std::vector<std::string> draw_plots(const Comparison& comparison, const std::filesystem::path& folder);

}  // namespace tack
