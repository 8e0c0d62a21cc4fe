// The search of a calibration: the evaluated points and the best one.
//
// Phases:
// - design: points that fill the ranges evenly, after the initial guess
// - chain: from each of the best design points, a short search by quadratic models (BOBYQA, Powell
//   2009, by NLopt)
// - polish: from the best point of all chains, Levenberg-Marquardt steps (by Ceres), if runs give
//   sensitivities that predict the residuals of nearby points
// - final chain: otherwise, a chain down to the tolerance, then Levenberg-Marquardt steps with
//   central differences
//
// A failed point counts as bad as the worst before it. The design is needed because curves with
// sudden breaks have misfits with steps and many minima, where a local method alone often ends in
// the wrong one.
//
// Each search is a deterministic sequence: its points do not depend on which run finishes first.
#pragma once

#include <functional>

#include "framework/calibrate/derivatives.hpp"
#include "framework/calibrate/point_queue.hpp"

namespace tack {

struct SearchRow {
  std::string phase;  // "design", "chain 1", "final chain", "polish", "derivatives"
  PointEvaluation evaluation;
};

struct SearchResult {
  // Each point once, at its first request, and once more for its derivatives.
  std::vector<SearchRow> rows;
  PointEvaluation best;
  Derivatives derivatives;  // at the best point
};

// Called with the phase that begins, its number of points (0: unknown), and the best point so far.
using SearchProgress =
    std::function<void(const std::string& phase, int points, const PointEvaluation* best)>;

// Searches for the best point. `noise_known`: residuals are in units of the noise. Throws
// SimulationError if no point of the design could be evaluated, and Interrupted.
SearchResult search_for(const std::vector<FittedParameter>& parameters, const SearchConfig& config,
                        Evaluator& evaluator, const SearchProgress& progress,
                        bool noise_known = true);

}  // namespace tack
